# cmake -DSOURCE=… -DBUILD=… -DWORK=… -DCXX=… -P consume.cmake
# Installs the build into WORK, builds the consumer against it and as a subdirectory, and runs both.
set(example ${SOURCE}/spectral/examples/spectral_brdf.cpp)
set(configure ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -G Ninja -DCMAKE_CXX_COMPILER=${CXX}
              -DCMAKE_BUILD_TYPE=Release -DEXAMPLE=${example})

function(run)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${configure} -B ${WORK}/installed -DCMAKE_PREFIX_PATH=${WORK}/prefix)
run(${CMAKE_COMMAND} --build ${WORK}/installed)
run(${WORK}/installed/consumer)
# unoptimised, which takes half the time
run(${configure} -B ${WORK}/subdirectory -DHTS_SUBDIRECTORY=${SOURCE} -DCMAKE_BUILD_TYPE=Debug)
run(${CMAKE_COMMAND} --build ${WORK}/subdirectory --parallel 2 --target consumer)
run(${WORK}/subdirectory/consumer)
