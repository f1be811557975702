# Everything comes from Debian 12 packages. OpenImageIO by pkg-config: its CMake config asks for OpenCV headers
# that it does not need.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TBB REQUIRED)
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO)
pkg_check_modules(GeographicLib REQUIRED IMPORTED_TARGET geographiclib)
pkg_check_modules(Epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(Egl REQUIRED IMPORTED_TARGET egl)
pkg_check_modules(Erfa REQUIRED IMPORTED_TARGET erfa)
pkg_check_modules(XxHash REQUIRED IMPORTED_TARGET libxxhash)
