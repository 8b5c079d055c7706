# cmake -DCOMPILER=… -DFLAGS=… -DSOURCE=… -DEXPECTED=… -P must_not_compile.cmake
# Passes when the compiler refuses SOURCE with a message that matches EXPECTED; with EXPECTED empty, when it accepts it.
execute_process(COMMAND "${COMPILER}" ${FLAGS} -fsyntax-only "${SOURCE}" RESULT_VARIABLE status
                OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(EXPECTED STREQUAL "")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${SOURCE} should compile:\n${output}")
  endif()
elseif(status EQUAL 0)
  message(FATAL_ERROR "${SOURCE} compiles, but must not")
elseif(NOT output MATCHES "${EXPECTED}")
  message(FATAL_ERROR "${SOURCE} is refused, but not with a message that matches \"${EXPECTED}\":\n${output}")
endif()
