# One function per kind of target, so that each folder's list names only its sources and neighbours.
include(GoogleTest)

# kiln_library(NAME SOURCES a.cpp ... [PUBLIC dep ...] [PRIVATE dep ...]) -> target kiln_NAME, alias kiln::NAME
function(kiln_library NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(kiln_${NAME} STATIC ${ARG_SOURCES})
  add_library(kiln::${NAME} ALIAS kiln_${NAME})
  target_link_libraries(kiln_${NAME} PUBLIC kiln_options ${ARG_PUBLIC} PRIVATE kiln_warnings ${ARG_PRIVATE})
endfunction()

# kiln_interface(NAME [deps...]) for folders that hold headers alone
function(kiln_interface NAME)
  add_library(kiln_${NAME} INTERFACE)
  add_library(kiln::${NAME} ALIAS kiln_${NAME})
  target_link_libraries(kiln_${NAME} INTERFACE kiln_options ${ARGN})
endfunction()

# kiln_program(kiln-x SOURCES main.cpp ... DEPS ...) -> build/bin/kiln-x
function(kiln_program NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${NAME} ${ARG_SOURCES})
  target_link_libraries(${NAME} PRIVATE kiln_options kiln_warnings ${ARG_DEPS})
  target_compile_definitions(${NAME} PRIVATE KILN_VERSION="${PROJECT_VERSION}")
  set_property(GLOBAL APPEND PROPERTY KILN_PROGRAMS ${NAME})
endfunction()

# kiln_test(NAME SOURCES ... DEPS ... [LABEL unit] [TIMEOUT 30] [DISPLAY]) -> one ctest entry running the gtest binary.
# DISPLAY runs it under its own Xvfb.
function(kiln_test NAME)
  cmake_parse_arguments(ARG "DISPLAY" "LABEL;TIMEOUT" "SOURCES;DEPS" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 30)
  endif()
  add_executable(${NAME} ${ARG_SOURCES})
  set_target_properties(${NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${NAME} PRIVATE kiln_options kiln_warnings kiln::test_paths ${ARG_DEPS} GTest::gmock
    GTest::gtest_main)
  if(ARG_DISPLAY)
    add_test(NAME ${NAME} COMMAND xvfb-run -a -s "-screen 0 1680x1050x24" $<TARGET_FILE:${NAME}>)
  else()
    add_test(NAME ${NAME} COMMAND ${NAME})
  endif()
  set_tests_properties(${NAME} PROPERTIES LABELS ${ARG_LABEL} TIMEOUT ${ARG_TIMEOUT})
endfunction()

# kiln_bench(NAME SOURCES ... DEPS ...) -> a google/benchmark program, run by `./kiln bench`, never by ctest
function(kiln_bench NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${NAME} ${ARG_SOURCES})
  set_target_properties(${NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bench)
  target_link_libraries(${NAME} PRIVATE kiln_options kiln_warnings kiln::test_paths ${ARG_DEPS} benchmark::benchmark_main)
  set_property(GLOBAL APPEND PROPERTY KILN_BENCHES ${NAME})
endfunction()

# kiln_folders(a b ...): add those folders that have a list of their own
function(kiln_folders)
  foreach(folder ${ARGN})
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/CMakeLists.txt)
      add_subdirectory(${folder})
    endif()
  endforeach()
endfunction()

# kiln_aggregates(): the targets `programs` (what ./kiln build makes) and `benches`; to be called last
function(kiln_aggregates)
  get_property(programs GLOBAL PROPERTY KILN_PROGRAMS)
  get_property(benches GLOBAL PROPERTY KILN_BENCHES)
  add_custom_target(programs DEPENDS ${programs})
  add_custom_target(benches DEPENDS ${benches})
endfunction()
