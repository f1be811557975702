#pragma once

// One clone of a function for each width of vector the processor may have, chosen when the program starts.
// The results are the same bits: no clone contracts multiplications and additions. Not under the sanitizers,
// which start too late.
//
// Loops over kLanes values, straight-line inside, become vector code; what they call must be inlined, or it
// would be code for the narrowest vectors.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GLOBE_FOR_EVERY_VECTOR_WIDTH __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define GLOBE_FOR_EVERY_VECTOR_WIDTH
#endif
#define GLOBE_INLINE __attribute__((always_inline)) inline
