# Writes OUTPUT, a source file that holds the bytes of INPUT as the string_view that HEADER declares as FUNCTION.
file(READ ${INPUT} bytes HEX)
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
string(REPEAT "." 80 line)
string(REGEX REPLACE "(${line})" "\\1\n  " bytes "${bytes}")
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

namespace cellcrush {

std::string_view ${FUNCTION}() {
  static constexpr unsigned char kBytes[] = {
  ${bytes}
  };
  return {reinterpret_cast<const char*>(kBytes), sizeof(kBytes)};
}

}  // namespace cellcrush
")
