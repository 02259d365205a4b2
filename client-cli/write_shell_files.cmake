# Lets PROGRAM write its completion scripts and its man page into FOLDER.
file(MAKE_DIRECTORY ${FOLDER})
foreach(shell bash zsh fish)
  execute_process(
    COMMAND ${PROGRAM} completion ${shell} OUTPUT_FILE ${FOLDER}/completion.${shell} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
execute_process(COMMAND ${PROGRAM} man OUTPUT_FILE ${FOLDER}/cellcrush.1 COMMAND_ERROR_IS_FATAL ANY)
