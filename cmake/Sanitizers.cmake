# Programs of a sanitizer build keep every library loaded; keep_libraries.cpp says why. Include this before the
# first executable.
if(SCENE_ANALYZER_SANITIZE)
  add_library(keep_libraries OBJECT ${CMAKE_SOURCE_DIR}/tests/sanitizers/keep_libraries.cpp)
  link_libraries($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:keep_libraries>)
endif()
