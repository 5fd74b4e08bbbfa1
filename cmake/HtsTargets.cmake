# How this project's targets are made: the same warnings, the same include root, the same export.

# Warnings belong to our own sources only, so they are private to each target.
function(hts_warnings target)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow
                                             $<$<BOOL:${HTS_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# hts_library(core SOURCES … HEADERS …): static library hts_core, alias hts::core, installed as such.
function(hts_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS" ${ARGN})
    set(target hts_${name})
    add_library(${target} STATIC ${ARG_SOURCES})
    add_library(hts::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/hts-reflectance>)
    hts_warnings(${target})
    if(HTS_INSTALL)
        install(TARGETS ${target} EXPORT hts ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
        file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
        install(FILES ${ARG_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hts-reflectance/${folder})
    endif()
endfunction()

# hts_tests(core LIBRARIES … SOURCES …): test program hts_core_tests, each test case its own ctest.
function(hts_tests name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
    set(target hts_${name}_tests)
    add_executable(${target} ${ARG_SOURCES})
    target_link_libraries(${target} PRIVATE ${ARG_LIBRARIES} hts_catch_main)
    target_compile_definitions(${target} PRIVATE HTS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    hts_warnings(${target})
    include(Catch)
    catch_discover_tests(${target} TEST_PREFIX "${name}: ")
endfunction()
