// What all benchmarks share: bench_NAME [--out FILE] [--seed N] [--quick]. Rows are appended to FILE, one flat JSON
// object a line; figures carry their unit in the name.
#pragma once

#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace posed::test {

class BenchOutput {
 public:
  // Throws std::runtime_error for what is no option.
  BenchOutput(int argc, char** argv) {
    for (int i = 1; i < argc; ++i) {
      const std::string word = argv[i];
      const bool has_value = i + 1 < argc;
      if (word == "--quick") {
        quick_ = true;
      } else if (word == "--out" && has_value) {
        file_ = std::fopen(argv[++i], "a");
        if (!file_) throw std::runtime_error(std::string("cannot write ") + argv[i]);
      } else if (word == "--seed" && has_value) {
        seed_ = std::strtoull(argv[++i], nullptr, 10);
      } else {
        throw std::runtime_error("takes [--out FILE] [--seed N] [--quick], not " + word);
      }
    }
  }
  ~BenchOutput() {
    if (file_) std::fclose(file_);
  }
  BenchOutput(const BenchOutput&) = delete;
  BenchOutput& operator=(const BenchOutput&) = delete;

  bool quick() const { return quick_; }
  std::uint64_t seed() const { return seed_; }

  __attribute__((format(printf, 2, 3))) void row(const char* format, ...) {
    if (!file_) return;
    std::va_list arguments;
    va_start(arguments, format);
    std::vfprintf(file_, format, arguments);
    va_end(arguments);
    std::fputc('\n', file_);
  }

 private:
  bool quick_ = false;
  std::uint64_t seed_ = 1;
  std::FILE* file_ = nullptr;
};

}  // namespace posed::test
