# add_shaders(<target> room/verb_noun.comp ... noun.vert noun.frag ...)
#
# Compiles GLSL, .comp below shaders/compute and others below shaders/raster, to SPIR-V and embeds it:
# build/<preset>/shaders/<verb_noun>.spv.h holds the words as `const uint32_t <verb_noun>_spv[]`, of noun.vert it is
# <noun_vert>. Included headers are tracked through a depfile. Include each
# generated header in exactly one .cpp, after <cstdint>.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
function(add_shaders target)
  set(output_folder ${CMAKE_BINARY_DIR}/shaders)
  foreach(shader IN LISTS ARGN)
    get_filename_component(stem ${shader} NAME_WE)
    get_filename_component(stage ${shader} LAST_EXT)
    set(source ${CMAKE_SOURCE_DIR}/shaders/compute/${shader})
    if(NOT stage STREQUAL .comp)
      string(REPLACE "." "_" stem "${stem}${stage}")
      set(source ${CMAKE_SOURCE_DIR}/shaders/raster/${shader})
    endif()
    set(header ${output_folder}/${stem}.spv.h)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${output_folder}
      COMMAND ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.3 -I${CMAKE_SOURCE_DIR}/shaders
              --depfile ${header}.d --vn ${stem}_spv -o ${header} ${source}
      DEPENDS ${source}
      DEPFILE ${header}.d
      COMMENT "SPIR-V ${shader}"
      VERBATIM)
    target_sources(${target} PRIVATE ${header})
  endforeach()
  target_include_directories(${target} PRIVATE ${output_folder})
endfunction()
