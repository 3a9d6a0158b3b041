// Reads tests/golden/FAMILY/*.hex: hexadecimal bytes, with comments from # to the end of a line.
#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace posed::test {

// `folder`: tests/golden/FAMILY. Throws where there is no such file.
inline std::vector<std::uint8_t> golden_bytes(const std::string& folder, const std::string& name) {
  std::ifstream file(folder + "/" + name + ".hex");
  if (!file) throw std::runtime_error("no golden file " + folder + "/" + name + ".hex");
  std::vector<std::uint8_t> bytes;
  for (std::string line; std::getline(file, line);) {
    line.resize(std::min(line.find('#'), line.size()));
    std::size_t at = 0;
    while ((at = line.find_first_not_of(" \t", at)) != std::string::npos) {
      bytes.push_back(static_cast<std::uint8_t>(std::stoi(line.substr(at, 2), nullptr, 16)));
      at += 2;
    }
  }
  return bytes;
}

}  // namespace posed::test
