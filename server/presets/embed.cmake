# Writes OUTPUT, a C++ source with the texts of this folder.
file(READ ${CMAKE_CURRENT_LIST_DIR}/presets.txtpb presets)
file(READ ${CMAKE_CURRENT_LIST_DIR}/materials.txtpb materials)
file(READ ${CMAKE_CURRENT_LIST_DIR}/measured_errors.csv errors)
file(READ ${CMAKE_CURRENT_LIST_DIR}/small_specimens.csv specimens)
file(READ ${CMAKE_CURRENT_LIST_DIR}/default_meshes.csv meshes)
file(WRITE ${OUTPUT} "#include \"translate/presets.h\"

namespace cellcrush::translate {

const char* presets_text() {
  return R\"text(${presets})text\";
}

const char* materials_text() {
  return R\"text(${materials})text\";
}

const char* measured_errors_text() {
  return R\"text(${errors})text\";
}

const char* small_specimens_text() {
  return R\"text(${specimens})text\";
}

const char* default_meshes_text() {
  return R\"text(${meshes})text\";
}

}  // namespace cellcrush::translate
")
