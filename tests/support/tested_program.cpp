#include "tests/system/process.hpp"

#ifdef SLIDEWAY_BINARY
char const* const slideway::testing::tested_program = SLIDEWAY_BINARY;
#else
char const* const slideway::testing::tested_program = "";
#endif
