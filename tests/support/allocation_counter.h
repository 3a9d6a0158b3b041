// Counts what this program takes from the heap: a program that calls it gets a counting global operator new.
#pragma once

#include <cstddef>

namespace posed::test {

std::size_t allocation_count();

}  // namespace posed::test
