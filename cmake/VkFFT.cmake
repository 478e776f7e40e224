# target_use_vkfft(<target> <source>): VkFFT's header for one source file, with the libraries that it needs.
#
# VkFFT 1.2.26 fills glslang_resource_t member by member; glslang 12 has nine members more (limits of mesh shaders)
# behind maxMeshViewCountNV. So the build folder gets a copy of the header with nine values more, and beside it the
# names of its error codes, which VkFFT has no function for.
find_path(VKFFT_FOLDER vkFFT.h REQUIRED)
find_path(GLSLANG_FOLDER glslang/Include/glslang_c_interface.h REQUIRED)

function(write_if_changed path content)
  if(EXISTS ${path})
    file(READ ${path} present)
    if(present STREQUAL content)
      return()
    endif()
  endif()
  file(WRITE ${path} "${content}")
endfunction()

function(make_vkfft_headers folder)
  set(advice "cmake/VkFFT.cmake was written for libvkfft-dev 1.2.26 and glslang-dev 12, and must be adapted")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${VKFFT_FOLDER}/vkFFT.h)
  file(READ ${VKFFT_FOLDER}/vkFFT.h header)
  set(last_value "/* .maxMeshViewCountNV = */ 4,")
  string(REPLACE "${last_value}" "${last_value} 256, 512, 32, 1, 1, 32, 1, 1, 4," patched "${header}")
  string(LENGTH "${header}" before)
  string(LENGTH "${patched}" after)
  math(EXPR inserted "${after} - ${before}")
  if(NOT inserted EQUAL 66)  # 33 characters at two places
    message(FATAL_ERROR "${VKFFT_FOLDER}/vkFFT.h does not have '${last_value}' twice: ${advice}.")
  endif()
  file(STRINGS ${GLSLANG_FOLDER}/glslang/Include/glslang_c_interface.h limits REGEX "max_(mesh|task)_.*_ext;")
  list(LENGTH limits limit_count)
  if(NOT limit_count EQUAL 9)
    message(FATAL_ERROR "glslang_resource_t has ${limit_count} limits of mesh shaders (_ext), not 9: ${advice}.")
  endif()

  file(STRINGS ${VKFFT_FOLDER}/vkFFT.h lines REGEX "^[ \t]*VKFFT_[A-Za-z0-9_]+ = [0-9]+,?")
  set(names "")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^[ \t]*(VKFFT_[A-Za-z0-9_]+) = ([0-9]+).*" "    {\\2, \"\\1\"},\n" line "${line}")
    string(APPEND names "${line}")
  endforeach()
  if(NOT names MATCHES "VKFFT_ERROR_FAILED_TO_ALLOCATE_MEMORY")
    message(FATAL_ERROR "${VKFFT_FOLDER}/vkFFT.h has no list of VKFFT_ERROR_...: ${advice}.")
  endif()
  write_if_changed(${folder}/vkFFT.h "${patched}")
  write_if_changed(${folder}/vkfft_error_names.h
    "struct VkfftErrorName {\n  int code;\n  const char* name;\n};\nconstexpr VkfftErrorName kVkfftErrorNames[] = {\n${names}};\n")
endfunction()

function(target_use_vkfft target source)
  set(folder ${CMAKE_BINARY_DIR}/vkfft)
  make_vkfft_headers(${folder})
  target_include_directories(${target} SYSTEM PRIVATE ${folder} ${GLSLANG_FOLDER})
  # Macros of ours that expand inside the header are not the system's to the compiler.
  # The header is one generator of shaders, which runs a few times per program and takes a compiler minutes to
  # optimise; and what UndefinedBehaviorSanitizer finds in code that is not ours, nobody here can mend.
  set(options -w -O1)
  if(SCENE_ANALYZER_SANITIZE)
    list(APPEND options -fno-sanitize=undefined)
  endif()
  set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "${options}" OBJECT_DEPENDS ${folder}/vkFFT.h)
  # Static, and in need of each other.
  set(libraries glslang HLSL SPIRV OSDependent MachineIndependent GenericCodeGen OGLCompiler SPIRV-Tools-opt SPIRV-Tools)
  set(paths "")
  foreach(library IN LISTS libraries)
    find_library(${library}_LIBRARY lib${library}.a REQUIRED)
    list(APPEND paths ${${library}_LIBRARY})
  endforeach()
  string(REPLACE ";" "," paths "${paths}")
  target_link_libraries(${target} PRIVATE $<LINK_GROUP:RESCAN,${paths}> Threads::Threads)
endfunction()
