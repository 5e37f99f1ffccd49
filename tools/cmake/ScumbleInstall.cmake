# cmake --install: program, library, headers, looks, pages, and a package for find_package(scumble).
include(CMakePackageConfigHelpers)

add_library(scumble::scumble ALIAS scumble)  # so that add_subdirectory and find_package give the same name
set(SCUMBLE_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/scumble)

install(TARGETS scumble scumble_shared EXPORT scumbleTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT scumbleTargets NAMESPACE scumble:: DESTINATION ${SCUMBLE_PACKAGE_FOLDER})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/scumble DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY ${CMAKE_SOURCE_DIR}/looks/ DESTINATION ${CMAKE_INSTALL_DATADIR}/scumble/looks
        FILES_MATCHING PATTERN "*.json")
install(DIRECTORY ${CMAKE_SOURCE_DIR}/farm DESTINATION ${CMAKE_INSTALL_DATADIR}/scumble)
# The pages with their pictures, in the folders that their links name.
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
        FILES_MATCHING PATTERN "*.md" PATTERN "*.png")

get_property(programs DIRECTORY ${CMAKE_SOURCE_DIR}/apps/scumble PROPERTY BUILDSYSTEM_TARGETS)
foreach(program ${programs})
  get_target_property(type ${program} TYPE)
  if(type STREQUAL "EXECUTABLE")
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()

configure_package_config_file(${CMAKE_SOURCE_DIR}/tools/cmake/scumbleConfig.cmake.in
                              ${CMAKE_BINARY_DIR}/scumbleConfig.cmake INSTALL_DESTINATION ${SCUMBLE_PACKAGE_FOLDER})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/scumbleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/scumbleConfig.cmake ${CMAKE_BINARY_DIR}/scumbleConfigVersion.cmake
        DESTINATION ${SCUMBLE_PACKAGE_FOLDER})

# What ./demo builds: the program, the scenes' generators, and the tool for painters that docs/sea.md sends to,
# without the tests.
if(SCUMBLE_TESTS)
  add_custom_target(demo)
  get_property(of_features GLOBAL PROPERTY SCUMBLE_DEMO_PROGRAMS)
  add_dependencies(demo ${programs} demo_files henry_room owl still_life ${of_features})
endif()
