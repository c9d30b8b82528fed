// SPDX-License-Identifier: GPL-3.0-or-later
// Which instruction set the vector kernels use. All paths give the same bits; PERRIN_CPU in the
// environment (portable, avx2, avx512) lowers the choice, for tests and benchmarks.
#pragma once

typedef enum CpuPath { CPU_PORTABLE, CPU_AVX2, CPU_AVX512, CPU_PATHS } CpuPath;

CpuPath cpu_path(void);
const char *cpu_path_name(CpuPath path);
