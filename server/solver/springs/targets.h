// The instruction sets that this folder is compiled for. Comes before hwy/foreach_target.h.
#pragma once

// Three are enough for x86-64: what all have, AVX2 and AVX-512.
#define HWY_DISABLED_TARGETS (HWY_AVX3_DL | HWY_SSE4)
