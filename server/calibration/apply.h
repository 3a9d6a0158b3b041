// What a calibration makes of a tracker's samples. Pure.
#pragma once

#include "common/calibration.h"
#include "common/frame.h"

namespace posed::calibration {

// The tip of a sensor in the source's frame, turned as the boresight says; `calibration` knows nothing of most
// stations.
Transform source_from_tip(const Calibration& calibration, int station, const Transform& source_from_sensor);
Transform world_from_tip(const Calibration& calibration, int station, const Transform& source_from_sensor);
// All samples of a frame, from the source to the world. Does not allocate.
void apply(const Calibration& calibration, Frame& frame);

}  // namespace posed::calibration
