# cmake --install: program, library, headers, looks, pages, and a package for find_package(scumble). Each thing
# belongs to a component, which is a package (ScumblePackages.cmake).
include(CMakePackageConfigHelpers)

add_library(scumble::scumble ALIAS scumble)  # so that add_subdirectory and find_package give the same name
set(SCUMBLE_PACKAGE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/scumble)

install(TARGETS scumble scumble_shared EXPORT scumbleTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
install(EXPORT scumbleTargets NAMESPACE scumble:: DESTINATION ${SCUMBLE_PACKAGE_FOLDER} COMPONENT development)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/scumble DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY ${CMAKE_SOURCE_DIR}/looks/ DESTINATION ${CMAKE_INSTALL_DATADIR}/scumble/looks COMPONENT program
        FILES_MATCHING PATTERN "*.json")
install(DIRECTORY ${CMAKE_SOURCE_DIR}/farm DESTINATION ${CMAKE_INSTALL_DATADIR}/scumble COMPONENT program)
# The pages with their pictures, in the folders that their links name.
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT documentation)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documentation
        FILES_MATCHING PATTERN "*.md" PATTERN "*.png")

get_property(programs DIRECTORY ${CMAKE_SOURCE_DIR}/apps/scumble PROPERTY BUILDSYSTEM_TARGETS)
foreach(program ${programs})
  get_target_property(type ${program} TYPE)
  if(type STREQUAL "EXECUTABLE")
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  endif()
endforeach()

# What desktops and shells know of the program.
install(FILES ${CMAKE_SOURCE_DIR}/packaging/scumble.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications
        COMPONENT program)
install(FILES ${CMAKE_SOURCE_DIR}/packaging/scumble.svg COMPONENT program
        DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${CMAKE_SOURCE_DIR}/packaging/scumble-mime.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages
        COMPONENT program RENAME scumble.xml)
install(FILES ${CMAKE_SOURCE_DIR}/packaging/scumble.metainfo.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo
        COMPONENT program RENAME org.scumble.scumble.metainfo.xml)
if(SCUMBLE_PYTHON AND NOT SCUMBLE_SANITIZE)
  # Manual pages and completion, from what the program says of itself.
  set(described ${CMAKE_BINARY_DIR}/described)
  set(describe ${CMAKE_SOURCE_DIR}/packaging/describe.py)
  add_custom_command(OUTPUT ${described}/scumble DEPENDS scumble_program ${describe}
                     COMMAND ${SCUMBLE_PYTHON} ${describe} $<TARGET_FILE:scumble_program> ${described})
  add_custom_target(describe_program ALL DEPENDS ${described}/scumble)
  install(DIRECTORY ${described}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program)
  install(FILES ${described}/scumble DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
else()
  message(STATUS "There is no python3: no manual pages are made")
endif()

configure_package_config_file(${CMAKE_SOURCE_DIR}/tools/cmake/scumbleConfig.cmake.in
                              ${CMAKE_BINARY_DIR}/scumbleConfig.cmake INSTALL_DESTINATION ${SCUMBLE_PACKAGE_FOLDER})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/scumbleConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${CMAKE_BINARY_DIR}/scumbleConfig.cmake ${CMAKE_BINARY_DIR}/scumbleConfigVersion.cmake
        DESTINATION ${SCUMBLE_PACKAGE_FOLDER} COMPONENT development)

# What ./demo builds: the program, the scenes' generators, and the tool for painters that docs/sea.md sends to,
# without the tests.
if(SCUMBLE_TESTS)
  add_custom_target(demo)
  get_property(of_features GLOBAL PROPERTY SCUMBLE_DEMO_PROGRAMS)
  add_dependencies(demo ${programs} demo_files henry_room owl still_life ${of_features})
endif()
