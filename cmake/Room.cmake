# room(<name> SOURCES a.cpp ... [DEPENDS room ...] [LINK lib ...] [SHADERS x.comp ...])
#
# One folder below src/host is one static library. DEPENDS are other rooms and are public, so that the
# dependency picture of the project can be read top to bottom in src/host/CMakeLists.txt; LINK are
# third-party libraries and stay private. SHADERS are relative to shaders/compute (see Shaders.cmake).
function(room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS;LINK;SHADERS" ${ARGN})
  list(TRANSFORM ROOM_SOURCES PREPEND "${CMAKE_SOURCE_DIR}/src/host/${name}/")
  add_library(${name} STATIC ${ROOM_SOURCES})
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR}/src/host ${CMAKE_SOURCE_DIR}/shaders)
  target_link_libraries(${name} PUBLIC ${ROOM_DEPENDS} PRIVATE ${ROOM_LINK})
  if(ROOM_SHADERS)
    add_shaders(${name} ${ROOM_SHADERS})
  endif()
endfunction()
