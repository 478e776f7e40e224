# room(<name> SOURCES a.cpp ... [ALONE b.cpp ...] [DEPENDS room ...] [LINK lib ...] [SHADERS x.comp ...])
#
# One folder below src/host is one static library. DEPENDS are other rooms and are public, so that the
# dependency picture of the project can be read top to bottom in src/host/CMakeLists.txt; LINK are
# third-party libraries and stay private. SHADERS are relative to shaders/compute (see Shaders.cmake).
#
# Sources are compiled several at a time, which takes a third of the time. Those whose unnamed namespaces have a
# name that another source of the room has as well are listed in ALONE.
function(room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;ALONE;DEPENDS;LINK;SHADERS" ${ARGN})
  list(TRANSFORM ROOM_SOURCES PREPEND "${CMAKE_SOURCE_DIR}/src/host/${name}/")
  list(TRANSFORM ROOM_ALONE PREPEND "${CMAKE_SOURCE_DIR}/src/host/${name}/")
  add_library(${name} STATIC ${ROOM_SOURCES} ${ROOM_ALONE})
  set_source_files_properties(${ROOM_ALONE} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR}/src/host ${CMAKE_SOURCE_DIR}/shaders)
  target_link_libraries(${name} PUBLIC ${ROOM_DEPENDS} PRIVATE ${ROOM_LINK})
  if(ROOM_SHADERS)
    add_shaders(${name} ${ROOM_SHADERS})
  endif()
endfunction()
