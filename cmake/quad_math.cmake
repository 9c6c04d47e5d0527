# Where long double is the quad type there is no libquadmath, and none is needed.
include(CheckCSourceCompiles)
set(CMAKE_REQUIRED_LIBRARIES quadmath)
check_c_source_compiles("
    __extension__ typedef __float128 quad;
    extern quad sqrtq(quad);
    int main(int count, char **text) { (void)text; return (int)sqrtq((quad)count); }"
    GOUGH_HAS_QUADMATH)
unset(CMAKE_REQUIRED_LIBRARIES)
set(GOUGH_MATH m)
if(GOUGH_HAS_QUADMATH)
    list(PREPEND GOUGH_MATH quadmath)
endif()
