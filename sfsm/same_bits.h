// For every source of sfsm: that it decides the same bits whatever it is compiled with. It is for no header, as what it
// asks for lasts to the end of the source; so no function in a header may multiply and add in one expression.
#pragma once

#include <cfloat>

// A product is rounded before it is added to. Compilers may otherwise fuse the two where the machine has an instruction
// for it (-march=native): GCC does so unless told not to, Clang within an expression.
#if defined(__clang__)
#pragma clang fp contract(off)
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif

// Laws look for NaN and infinity, and sums are taken in their order.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "found -ffast-math or a part of it, expected sfsm/*.cpp to be compiled with -fno-fast-math behind it"
#endif

static_assert(FLT_EVAL_METHOD == 0, "expected doubles to be calculated as doubles, as with -msse2 -mfpmath=sse");
