# What everyone needs who includes our headers. -ffp-contract=off keeps the geometry the same on every machine: a fused
# multiply-add rounds differently from the two operations it replaces (HARD-CASES H5, H8).
add_library(globe_headers INTERFACE)
target_compile_features(globe_headers INTERFACE cxx_std_20)
target_include_directories(globe_headers INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(globe_headers INTERFACE -ffp-contract=off)

# Flags every target of ours is built with.
add_library(globe_flags INTERFACE)
target_link_libraries(globe_flags INTERFACE globe_headers)
target_compile_options(globe_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 warns of overlaps inside std::string's operator+ that cannot happen (GCC bug 105651).
  target_compile_options(globe_flags INTERFACE -Wno-restrict)
endif()
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # GCC takes what an included .cpp has in its anonymous namespace for something of a header's.
  target_compile_options(globe_flags INTERFACE -Wno-subobject-linkage)
endif()
if(GLOBE_SANITIZE)
  target_compile_options(globe_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(globe_flags INTERFACE -fsanitize=address,undefined)
  # With the sanitizers in between, GCC takes much of the standard library for uninitialised.
  target_compile_options(globe_flags INTERFACE -Wno-maybe-uninitialized)
endif()

if(GLOBE_FUZZ)
  target_compile_options(globe_flags INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
  target_link_options(globe_flags INTERFACE -fsanitize=address,undefined)
endif()

# globe_library(NAME [PUBLIC libs...] [PRIVATE libs...]): a static library of every .cpp in this folder.
function(globe_library name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC globe_headers ${arg_PUBLIC} PRIVATE globe_flags ${arg_PRIVATE})
endfunction()
