# Writes OUTPUT, a header that names the commit of SOURCE, and touches it only when the commit changes.
cmake_minimum_required(VERSION 3.25)
set(commit unknown)
if(EXISTS "${SOURCE}/.git")
    execute_process(COMMAND git --no-optional-locks describe --always --dirty WORKING_DIRECTORY "${SOURCE}"
                    OUTPUT_VARIABLE described RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(described AND NOT failed)
        set(commit "${described}")
    endif()
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#define HTS_BENCH_COMMIT \"@commit@\"\n" @ONLY)
