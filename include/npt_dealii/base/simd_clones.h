// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the attribute of functions that are compiled for several processors.

#ifndef npt_dealii_base_simd_clones_h
#define npt_dealii_base_simd_clones_h

// One binary for every machine: the loader picks the version that the
// processor can run. Fused multiply-adds of four numbers reach two thirds of
// the peak of a processor with AVX2. ("avx2,fma" would be two versions, of
// which the loader takes the one without fused operations.)
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#  define NPT_SIMD_CLONES __attribute__((target_clones("fma", "default")))
#else
#  define NPT_SIMD_CLONES
#endif

#endif
