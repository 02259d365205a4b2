# Writes OUTPUT, a C++ source with the texts of this folder.
file(READ ${CMAKE_CURRENT_LIST_DIR}/presets.txtpb presets)
file(READ ${CMAKE_CURRENT_LIST_DIR}/measured_errors.csv errors)
file(READ ${CMAKE_CURRENT_LIST_DIR}/small_specimens.csv specimens)
file(WRITE ${OUTPUT} "#include \"translate/presets.h\"

namespace cellcrush::translate {

const char* presets_text() {
  return R\"text(${presets})text\";
}

const char* measured_errors_text() {
  return R\"text(${errors})text\";
}

const char* small_specimens_text() {
  return R\"text(${specimens})text\";
}

}  // namespace cellcrush::translate
")
