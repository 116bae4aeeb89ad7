# Writes OUTPUT, the definition of build_info() (experiments/program/version.hpp). Runs at every build; touches the file
# only where something changed. Give: SOURCE, OUTPUT, VERSION, COMPILER, CUDA.
execute_process(COMMAND git -C ${SOURCE} rev-parse HEAD OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE
  RESULT_VARIABLE failed ERROR_QUIET)
set(dirty false)
if(failed)
  set(commit unknown)
else()
  execute_process(COMMAND git -C ${SOURCE} status --porcelain OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(dirty true)
  endif()
endif()
set(text "#include \"experiments/program/version.hpp\"\n
ogc::experiments::BuildInfo ogc::experiments::build_info() {
  return {\"${VERSION}\", \"${commit}\", ${dirty}, \"${COMPILER}\", \"${CUDA}\"};
}\n")
set(written "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} written)
endif()
if(NOT text STREQUAL written)
  file(WRITE ${OUTPUT} "${text}")
endif()
