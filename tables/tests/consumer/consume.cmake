# cmake -DSOURCE=… -DBUILD=… -DWORK=… -DCXX=… -P consume.cmake
# Installs the build into WORK, builds the consumers against it, one of them by pkg-config and as a subdirectory, too,
# and runs them.
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
# the installed command finds what it loads for fits
if(EXISTS ${WORK}/prefix/bin/hts)
    run(${WORK}/prefix/bin/hts fit curet-sandpaper --starts 1 --most-points 40 --rings 0)
endif()
find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
    file(GLOB_RECURSE description ${WORK}/prefix/hts.pc)
    cmake_path(GET description PARENT_PATH folder)
    run(sh -c "PKG_CONFIG_PATH=${folder} && export PKG_CONFIG_PATH && \
        ${CXX} -std=c++20 ${example} $(${PKG_CONFIG} --cflags --libs hts) -o ${WORK}/by_pkg_config")
    run(${WORK}/by_pkg_config)
endif()
# the inputs that the documentation names
file(GLOB pages ${SOURCE}/README.md ${SOURCE}/docs/*.md ${SOURCE}/cli/verbs/*.cpp ${SOURCE}/cli/verbs/table/*.cpp)
foreach(page IN LISTS pages)
    file(READ ${page} text)
    string(REGEX MATCHALL "cli/data/[a-z0-9-]+\\.(json|csv)" names "${text}")
    foreach(name IN LISTS names)
        string(REPLACE "cli/data/" "share/hts/" installed ${name})
        if(NOT EXISTS ${WORK}/prefix/${installed})
            message(FATAL_ERROR "${page}: ${name} is not installed as ${installed}")
        endif()
    endforeach()
endforeach()
# unoptimised, which takes half the time
run(${configure} -B subdirectory -DHTS_SUBDIRECTORY=${SOURCE} -DCMAKE_BUILD_TYPE=Debug)
run(${CMAKE_COMMAND} --build subdirectory --parallel 2 --target consumer_spectral)
run(subdirectory/consumer_spectral)
