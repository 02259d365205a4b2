# Writes OUTPUT, a source file, from revision.cpp.in; leaves it alone when nothing has changed, so that nothing is
# compiled again.
#   cmake -DSOURCE=DIR -DOUTPUT=FILE -DVERSION=X.Y.Z -DAPI_VERSION=X.Y.Z -DRESULT_VERSION=X.Y.Z
#     -DSOLVER_VERSION=X.Y.Z -DBUILD=TEXT [-DGIT=PROGRAM] -P stamp_revision.cmake
# SOURCE is the top of the tree, BUILD names compiler and flags.
cmake_minimum_required(VERSION 3.25)

# The commit, where SOURCE is the top of a repository.
set(REVISION unknown)
set(ENV{GIT_OPTIONAL_LOCKS} 0)
if(GIT)
  execute_process(COMMAND ${GIT} rev-parse --show-prefix --short=12 HEAD WORKING_DIRECTORY ${SOURCE}
    OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  # Without a prefix the first line is empty: SOURCE is not a folder of somebody else's repository.
  if(NOT failed AND head MATCHES "^\n?([0-9a-f]+)$")
    set(REVISION ${CMAKE_MATCH_1})
    execute_process(COMMAND ${GIT} status --porcelain WORKING_DIRECTORY ${SOURCE}
      OUTPUT_VARIABLE changes ERROR_QUIET RESULT_VARIABLE failed)
    if(failed OR NOT changes STREQUAL "")
      string(APPEND REVISION -dirty)
    endif()
  endif()
endif()

# What the solver computes with: its sources, those that make its scene of a case, and what compiled them.
file(GLOB_RECURSE sources RELATIVE ${SOURCE}
  ${SOURCE}/core/*.h ${SOURCE}/core/*.cpp ${SOURCE}/core/CMakeLists.txt ${SOURCE}/server/translate/*.h
  ${SOURCE}/server/translate/*.cpp)
list(SORT sources)
set(hashes "${BUILD}\n")
foreach(source IN LISTS sources)
  file(SHA256 ${SOURCE}/${source} hash)
  string(APPEND hashes "${hash} ${source}\n")
endforeach()
string(SHA256 CORE_HASH "${hashes}")
string(SUBSTRING ${CORE_HASH} 0 12 CORE_HASH)

if(EXISTS ${SOURCE}/CITATION.cff)
  file(STRINGS ${SOURCE}/CITATION.cff CITATION REGEX "^message:")
  string(REGEX REPLACE "^message: \"(.*)\"$" "\\1" CITATION "${CITATION}")
endif()

configure_file(${CMAKE_CURRENT_LIST_DIR}/revision.cpp.in ${OUTPUT} @ONLY)
