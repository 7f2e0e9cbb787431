# How every target of the project is made. One library per module; dependencies point one way
# (tests/architecture checks the include graph against this graph).
include(GNUInstallDirs)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

# What public headers need is found here, once, for every folder.
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED)

find_program(SWALLOWTAIL_CCACHE ccache)
if(SWALLOWTAIL_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${SWALLOWTAIL_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${SWALLOWTAIL_CCACHE})
endif()

add_library(swallowtail_flags INTERFACE)
target_compile_options(swallowtail_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  $<$<BOOL:${SWALLOWTAIL_WERROR}>:-Werror>)
# Bit-for-bit results on every machine of a kind: no contraction into fused multiply-add.
target_compile_options(swallowtail_flags INTERFACE -ffp-contract=off)
if(SWALLOWTAIL_SANITIZE)
  target_compile_options(swallowtail_flags INTERFACE -fsanitize=${SWALLOWTAIL_SANITIZE} -fno-omit-frame-pointer
                                                     -fno-sanitize-recover=all
                                                     -Wno-maybe-uninitialized)  # false where GCC instruments
  target_link_options(swallowtail_flags INTERFACE -fsanitize=${SWALLOWTAIL_SANITIZE})
endif()

# swallowtail_library(NAME SOURCES ... [PUBLIC targets...] [PRIVATE targets...])
#   target swallowtail_NAME, alias swallowtail::NAME; headers are included from the project root.
function(swallowtail_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target swallowtail_${name})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/swallowtail>)
    target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE $<BUILD_INTERFACE:swallowtail_flags> ${ARG_PRIVATE})
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                   $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/swallowtail>)
    target_link_libraries(${target} INTERFACE ${ARG_PUBLIC})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(swallowtail::${name} ALIAS ${target})
endfunction()

# swallowtail_program(NAME SOURCES ... LINK ...): executable build/bin/NAME
function(swallowtail_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE swallowtail_flags ${ARG_LINK})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# swallowtail_test(NAME SOURCES ... LINK ... [LABELS ...] [TIMEOUT seconds]): one GoogleTest executable, one ctest entry;
#   under sanitizers it may take ten times as long
function(swallowtail_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINK;LABELS;ENVIRONMENT" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 60)
  endif()
  if(SWALLOWTAIL_SANITIZE)
    math(EXPR ARG_TIMEOUT "10 * ${ARG_TIMEOUT}")
  endif()
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE swallowtail_flags ${ARG_LINK} GTest::gtest_main GTest::gmock)
  target_compile_definitions(${name} PRIVATE
    SWALLOWTAIL_SOURCE_DIR="${PROJECT_SOURCE_DIR}" SWALLOWTAIL_BINARY_DIR="${PROJECT_BINARY_DIR}")
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT}
    ENVIRONMENT "${ARG_ENVIRONMENT}")
endfunction()

# Adds the folders that exist (a source package may leave out a family).
function(swallowtail_folders)
  foreach(folder ${ARGN})
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/CMakeLists.txt)
      add_subdirectory(${folder})
    endif()
  endforeach()
endfunction()
