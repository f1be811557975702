# embed_shaders(TARGET): gives the target a source that holds every file under shaders/ (globe/gl/embedded_shaders.h).
function(embed_shaders target)
  set(folder ${PROJECT_SOURCE_DIR}/shaders)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${folder} ${folder}/*.glsl ${folder}/*.vert ${folder}/*.tesc
    ${folder}/*.tese ${folder}/*.geom ${folder}/*.frag ${folder}/*.comp)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp)
  list(TRANSFORM files PREPEND ${folder}/ OUTPUT_VARIABLE paths)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${folder} "-DFILES=${files}" -DOUTPUT=${output}
      -P ${PROJECT_SOURCE_DIR}/cmake/write_embedded_shaders.cmake
    DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/write_embedded_shaders.cmake
    COMMENT "Embedding shaders" VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
