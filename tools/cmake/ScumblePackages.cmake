# cpack: Debian's packages, one a component (./package calls it).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The scumble team <maintainers@scumble.example>")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_COMPONENTS_ALL program library development documentation)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(library libscumble${PROJECT_VERSION_MAJOR})

# deb(COMPONENT NAME SECTION DESCRIPTION): what all of them have. Of the description, the first line is the summary.
macro(deb component name section description)
  string(TOUPPER ${component} COMPONENT)
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${COMPONENT}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${COMPONENT}_DESCRIPTION "${description}")
  # What each of Debian's packages brings about itself.
  install(FILES ${CMAKE_SOURCE_DIR}/packaging/copyright ${CMAKE_BINARY_DIR}/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
  if(EXISTS ${CMAKE_SOURCE_DIR}/packaging/${name}.lintian-overrides)
    install(FILES ${CMAKE_SOURCE_DIR}/packaging/${name}.lintian-overrides COMPONENT ${component}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME ${name})
  endif()
endmacro()

find_program(GZIP gzip REQUIRED)
set_property(DIRECTORY ${CMAKE_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/packaging/changelog)
execute_process(COMMAND ${GZIP} -9nc ${CMAKE_SOURCE_DIR}/packaging/changelog
                OUTPUT_FILE ${CMAKE_BINARY_DIR}/changelog.gz COMMAND_ERROR_IS_FATAL ANY)

deb(program scumble graphics "painterly renderer: glTF scenes become moving paintings
scumble takes a glTF 2.0 scene, or a painting made in space, and a look, and
paints pictures and films of it: flat colours and torn edges, drawn lines and
washes, or strokes of a brush. It has a command line and a window.
.
It runs on any Vulkan 1.3 GPU, and on the CPU by Mesa's driver.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "ffmpeg, mesa-vulkan-drivers | vulkan-icd")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libopenxr-loader1, scumble-doc, vulkan-validationlayers")

deb(library ${library} libs "painterly renderer (shared library)
scumble paints pictures and films of glTF scenes. This is its library, for
engines and other languages, with a C++ and a C face.")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/packaging/triggers)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "ffmpeg, mesa-vulkan-drivers | vulkan-icd")

deb(development libscumble-dev libdevel "painterly renderer (headers and static library)
scumble paints pictures and films of glTF scenes. These are its headers, its
static library and a CMake package.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library} (= ${PROJECT_VERSION}), libdraco-dev, libembree-dev, libfmt-dev, libglm-dev, libjpeg62-turbo-dev, libkissfft-dev, libmeshoptimizer-dev, libopenexr-dev, libpng-dev, libtbb-dev, libvulkan-dev, libwebp-dev, libzip-dev, nlohmann-json3-dev, pkg-config, zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, scumble-doc")

deb(documentation scumble-doc doc "painterly renderer (documentation)
scumble paints pictures and films of glTF scenes. These are its pages, with
pictures: art direction, every knob, embedding, and how it is built.")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SUGGESTS "scumble")

if(TARGET scumble_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  deb(python python3-scumble python "painterly renderer (Python module)
scumble paints pictures and films of glTF scenes. This is its module for
Python 3: scenes from files and arrays, looks, frames as numpy arrays, films.")
  # The library is not installed where this is made: what it is called stands here, and what it needs is its own matter.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR})
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${library} (= ${PROJECT_VERSION}), python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "ffmpeg, mesa-vulkan-drivers | vulkan-icd")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "scumble-doc")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/packaging/python/postinst ${CMAKE_SOURCE_DIR}/packaging/python/prerm)
endif()

include(CPack)
