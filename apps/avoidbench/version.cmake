# Run at each build: writes OUTPUT from TEMPLATE, touched only where something changed.
execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=*
                WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE GIT_HASH ERROR_QUIET
                OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT GIT_HASH)
  set(GIT_HASH unknown)
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
