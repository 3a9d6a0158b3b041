# posed_library(NAME PUBLIC libs... PRIVATE libs...): one static library a folder, made of its *.cpp. The link lists are the
# architecture: see ARCHITECTURE.md and tests/layering_test.py. posed_program and posed_test are the same for programs.

add_library(posed_flags INTERFACE)
target_compile_options(posed_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(POSED_WERROR)
  target_compile_options(posed_flags INTERFACE -Werror)
endif()
if(POSED_SANITIZE)
  target_compile_options(posed_flags INTERFACE -fsanitize=${POSED_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(posed_flags INTERFACE -fsanitize=${POSED_SANITIZE})
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()

# Tests spend more time in the compiler than in the processor once every line is checked: theirs are not optimised then.
add_library(posed_test_flags INTERFACE)
target_link_libraries(posed_test_flags INTERFACE posed_flags)
if(POSED_SANITIZE)
  target_compile_options(posed_test_flags INTERFACE -O0)
endif()

# libFuzzer steers by what the libraries do.
add_library(posed_library_flags INTERFACE)
target_link_libraries(posed_library_flags INTERFACE posed_flags)
if(POSED_FUZZ)
  target_compile_options(posed_library_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

function(posed_library name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp */*.cpp)
  add_library(posed_${name} STATIC ${sources})
  target_include_directories(posed_${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(posed_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} posed_library_flags)
endfunction()

function(posed_program name)
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARGN} posed_flags)
endfunction()
