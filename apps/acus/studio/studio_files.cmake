# Puts the built page (studio/dist, where there is one) into the program: writes a source file that includes the bytes of
# each file, and adds it to TARGET.
function(acus_embed_studio target)
  set(dist ${PROJECT_SOURCE_DIR}/studio/dist)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${dist} ${dist}/*)
  set(assembly "")
  set(declarations "")
  set(rows "")
  set(number 0)
  foreach(file ${files})
    string(APPEND assembly "asm(\".section .rodata\\n\"\n    \".global acus_studio_${number}\\nacus_studio_${number}:\\n\"\n"
      "    \".incbin \\\"${dist}/${file}\\\"\\n\"\n    \".global acus_studio_${number}_end\\nacus_studio_${number}_end:\\n.byte 0\\n.previous\\n\");\n")
    string(APPEND declarations "extern const char acus_studio_${number}[], acus_studio_${number}_end[];\n")
    string(APPEND rows "      {\"/${file}\", acus_studio_${number}, acus_studio_${number}_end},\n")
    math(EXPR number "${number} + 1")
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/studio_file_table.cpp)
  string(CONCAT text "#include \"studio/studio_file_table.h\"\n\n#include <vector>\n\n${assembly}\nextern \"C\" {\n${declarations}}\n\n"
    "std::span<const acus::app::EmbeddedFile> acus::app::embedded_files() {\n"
    "  static const std::vector<EmbeddedFile> files = {\n${rows}  };\n  return files;\n}\n")
  file(CONFIGURE OUTPUT ${source} CONTENT "${text}" @ONLY)
  list(TRANSFORM files PREPEND ${dist}/)
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${files}" SKIP_PRECOMPILE_HEADERS ON)
  target_sources(${target} PRIVATE ${source})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()
