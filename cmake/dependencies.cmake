# What the build needs from the system; scripts/install-packages.sh installs it.
find_package(PkgConfig REQUIRED)
pkg_check_modules(LIBFYAML REQUIRED IMPORTED_TARGET libfyaml)
pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson)
pkg_check_modules(LAPACKE REQUIRED IMPORTED_TARGET lapacke lapack)
pkg_check_modules(NLOPT REQUIRED IMPORTED_TARGET nlopt)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)

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
