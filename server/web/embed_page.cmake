# Writes OUTPUT, a C++ source with all files of the folder BUNDLE.
file(GLOB files ${BUNDLE}/*)
set(arrays)
set(entries)
set(number 0)
foreach(file ${files})
  get_filename_component(name ${file} NAME)
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," bytes "${bytes}")
  string(APPEND arrays "constexpr char kFile${number}[] = {${bytes}'\\0'};\n")
  string(APPEND entries "    {\"${name}\", {kFile${number}, sizeof(kFile${number}) - 1}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT} "#include <span>\n\n#include \"web/page_files.h\"\n\nnamespace cellcrush::web {\n\n"
  "std::span<const PageFile> page_files();\n\n${arrays}constexpr PageFile kFiles[] = {\n${entries}};\n\n"
  "std::span<const PageFile> page_files() { return kFiles; }\n\n}  // namespace cellcrush::web\n")
