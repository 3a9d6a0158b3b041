// Every message of PROTOCOL.md as a struct.
#pragma once

#include "proto/requests.h"
#include "proto/results.h"
#include "proto/stream_data.h"
