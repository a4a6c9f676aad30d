// What a caller of the kernels keeps, said in code: looked at where SLIDEWAY_CHECKED is defined (builds with sanitizers, and with -DSLIDEWAY_CHECKED=ON),
// free elsewhere.  Bad input never gets so far; what fails here is a defect of the program.
#pragma once

#if defined(SLIDEWAY_CHECKED) && !defined(__CUDACC__)
#include <cstdio>
#include <cstdlib>

/// Ends the program, with the place and the condition, where that does not hold.  Of packs ask `none` of what must not be, for an idle lane may hold NaN.
#define SLIDEWAY_EXPECT(...) \
    ((__VA_ARGS__) ? void() : (static_cast<void>(std::fprintf(stderr, "%s:%d: expected: %s\n", __FILE__, __LINE__, #__VA_ARGS__)), std::abort()))
#else
#define SLIDEWAY_EXPECT(...) static_cast<void>(sizeof((__VA_ARGS__) ? 1 : 0))
#endif
