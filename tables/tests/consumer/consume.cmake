# cmake -DSOURCE=… -DBUILD=… -DWORK=… -DCXX=… -P consume.cmake
# Installs the build into WORK, builds the consumers against it and one of them as a subdirectory, and runs them.
set(example ${SOURCE}/spectral/examples/spectral_brdf.cpp)
set(configure ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -G Ninja -DCMAKE_CXX_COMPILER=${CXX} -DEXAMPLE=${example})

function(run)
    execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${configure} -B installed -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build installed)
foreach(name core spectral model tables)
    run(installed/consumer_${name})
endforeach()
# unoptimised, which takes half the time
run(${configure} -B subdirectory -DHTS_SUBDIRECTORY=${SOURCE} -DCMAKE_BUILD_TYPE=Debug)
run(${CMAKE_COMMAND} --build subdirectory --parallel 2 --target consumer_spectral)
run(subdirectory/consumer_spectral)
