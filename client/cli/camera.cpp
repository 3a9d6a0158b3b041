#include "client/cli/output.h"

namespace posed::cli {

Quat looking(const Vec3& from, const Vec3& at) {
  const Vec3 way = at - from;
  if (glm::length(way) < 1e-12) return quat_identity();
  const double heading = std::atan2(way.y, way.x), climb = std::atan2(way.z, std::hypot(way.x, way.y));
  return quat_about(kZ, heading) * quat_about(kY, -climb);
}

int list_cameras(const Session& session) {
  return request<proto::CameraListResult>(session, proto::CameraList{}, [](const proto::CameraListResult& list) {
    if (list.cameras.empty()) print_line("no cameras");
    for (const proto::CameraResult& entry : list.cameras) {
      const Camera& camera = entry.camera;
      const Vec3& p = camera.base_from_camera.position;
      std::string line = camera.id + format("  [%g %g %g] m", p.x, p.y, p.z) + show_base(camera.relative_to);
      line += format("  %g degrees", camera.fov_y * 180.0 / M_PI);
      if (!camera.label.empty()) line += "  " + camera.label;
      print_line(line);
    }
  });
}

int set_camera(const Session& session, const proto::CameraSet& camera) {
  return request<proto::EditResult>(session, camera, print_set);
}

int remove_camera(const Session& session, const std::string& id) {
  return edit(session, proto::CameraRemove{id}, id + " is removed");
}

}  // namespace posed::cli
