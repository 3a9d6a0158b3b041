// Before it is known which face a peer speaks to.
#pragma once

#include <functional>
#include <string>

#include "server/net/detect.h"
#include "server/net/face.h"

namespace posed::net {

class DetectFace : public Face {
 public:
  // `make` gives the face for what was detected.
  using Make = std::function<std::unique_ptr<Face>(Detected)>;
  DetectFace(Link& link, Nanoseconds patience, Make make) : link_(link), patience_(patience), make_(std::move(make)) {}

  void take(std::string_view bytes) override {
    if (bytes.empty()) return;
    if (first_.empty()) link_.deadline(patience_);
    first_.append(bytes);
    const Detected detected = detect(first_);
    if (detected != Detected::undecided) become(detected);
  }
  bool stuck() const override { return false; }
  bool ready() const override { return false; }
  void end() override {
    if (!first_.empty()) become(Detected::lines);
  }

 private:
  void become(Detected detected) {
    link_.deadline(0);
    if (detected == Detected::lines) link_.open(false);
    const std::string first = std::move(first_);
    link_.become(make_(detected), first);
  }

  Link& link_;
  Nanoseconds patience_;
  Make make_;
  std::string first_;
};

}  // namespace posed::net
