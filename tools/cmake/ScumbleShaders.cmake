# scumble_shaders(FILES...): compiles GLSL to SPIR-V, validates it, and makes for each FOO.vert a header
# shaders/FOO_vert.h with the array scumble::shaders::FOO_vert. NAME.image.glsl is compiled twice, as
# NAME_image_frag and NAME_image_comp (src/shading/image_pass.glsl). scumble_shader_variant(FOO.vert WORD DEFINES...): once
# more with those macros, as foo_WORD_vert; NAME.image.glsl as NAME_WORD_image_frag and NAME_WORD_image_comp.
function(scumble_compile_shader source name stage defines)
  set(dir ${CMAKE_BINARY_DIR}/generated/shaders)
  set(spirv ${dir}/${name}.spv)
  set(header ${dir}/${name}.h)
  add_custom_command(
    OUTPUT ${header}
    COMMAND ${Vulkan_GLSLC_EXECUTABLE} --target-env=vulkan1.3 -O -fshader-stage=${stage} ${defines} -MD -MF ${spirv}.d
            -MT ${header} -o ${spirv} ${source}
    COMMAND ${SPIRV_VAL} --target-env vulkan1.3 --scalar-block-layout ${spirv}
    COMMAND ${CMAKE_COMMAND} -DIN=${spirv} -DOUT=${header} -DNAME=${name}
            -P ${CMAKE_SOURCE_DIR}/tools/cmake/embed_spirv.cmake
    DEPENDS ${source} ${CMAKE_SOURCE_DIR}/tools/cmake/embed_spirv.cmake
    DEPFILE ${spirv}.d
    COMMENT "Shader ${name}" VERBATIM)
  # A target of its own, because a custom command's output is known in its own folder only.
  add_custom_target(shader_${name} DEPENDS ${header})
  add_dependencies(scumble shader_${name})
  set_property(GLOBAL APPEND PROPERTY SCUMBLE_SHADERS ${name})
  list(JOIN defines "\", \"" words)
  set(command "\"${Vulkan_GLSLC_EXECUTABLE}\", \"--target-env=vulkan1.3\", \"-O\", \"-fshader-stage=${stage}\"")
  if(defines)
    string(APPEND command ", \"${words}\"")
  endif()
  set_property(GLOBAL APPEND_STRING PROPERTY SCUMBLE_SHADER_COMMANDS
    "  {\"name\": \"${name}\", \"source\": \"${source}\", \"command\": [${command}]},\n")
endfunction()

# After all shaders are known: a table of them for the library, and generated/shaders/commands.json, which says
# how each is compiled, for who compiles them while a program runs.
function(scumble_shader_table)
  set(dir ${CMAKE_BINARY_DIR}/generated/shaders)
  get_property(names GLOBAL PROPERTY SCUMBLE_SHADERS)
  get_property(commands GLOBAL PROPERTY SCUMBLE_SHADER_COMMANDS)
  set(includes "")
  set(rows "")
  foreach(name ${names})
    string(APPEND includes "#include \"shaders/${name}.h\"\n")
    string(APPEND rows "    {\"${name}\", shaders::${name}},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${dir}/shader_table.cpp CONTENT "#include \"renderer/shader_table.h\"

@includes@
namespace scumble::renderer {
std::span<const NamedShader> shaderTable() {
  static constexpr NamedShader kTable[] = {
@rows@  };
  return kTable;
}
}  // namespace scumble::renderer
" @ONLY)
  target_sources(scumble PRIVATE ${dir}/shader_table.cpp)
  file(CONFIGURE OUTPUT ${dir}/commands.json CONTENT "[\n@commands@  {\"validator\": \"${SPIRV_VAL}\"}\n]\n" @ONLY)
endfunction()

function(scumble_shaders)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/generated/shaders)
  foreach(file ${ARGN})
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    get_filename_component(name ${file} NAME)
    if(name MATCHES "^(.*)\\.image\\.glsl$")
      scumble_compile_shader(${source} ${CMAKE_MATCH_1}_image_frag fragment "")
      scumble_compile_shader(${source} ${CMAKE_MATCH_1}_image_comp compute -DSCUMBLE_COMPUTE)
    elseif(name MATCHES "^(.*)\\.(vert|frag|comp)$")
      set(base ${CMAKE_MATCH_1}_${CMAKE_MATCH_2})
      scumble_compile_shader(${source} ${base} ${CMAKE_MATCH_2} "")
    endif()
  endforeach()
endfunction()

function(scumble_shader_variant file word)
  list(TRANSFORM ARGN PREPEND -D OUTPUT_VARIABLE defines)
  if(file MATCHES "^(.*)\\.image\\.glsl$")
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    scumble_compile_shader(${source} ${CMAKE_MATCH_1}_${word}_image_frag fragment "${defines}")
    scumble_compile_shader(${source} ${CMAKE_MATCH_1}_${word}_image_comp compute "-DSCUMBLE_COMPUTE;${defines}")
    return()
  endif()
  string(REGEX MATCH "^(.*)\\.(vert|frag|comp)$" matched ${file})
  scumble_compile_shader(${CMAKE_CURRENT_SOURCE_DIR}/${file} ${CMAKE_MATCH_1}_${word}_${CMAKE_MATCH_2} ${CMAKE_MATCH_2}
                         "${defines}")
endfunction()
