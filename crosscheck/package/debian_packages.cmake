# cpack -G DEB: the packages lockstep (program, shaders, scenes, manual) and liblockstep-dev (what other projects link).
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lockstep)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The lockstep developers <developers@lockstep.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "CPU reference and GPU cross-checker for particle shaders
Runs your GLSL and a plain C++ reference from the same state, frame by frame,
and compares every bit. The report names the first particle and the first
operation that differ, and the mistake behind it.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${CPACK_COMPONENT_PROGRAM_DESCRIPTION}

This package has the library and the headers for tests of your own shaders.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME lockstep)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# GL is opened at run time.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libegl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libosmesa6, liblockstep-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblockstep-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "lockstep (= ${PROJECT_VERSION}), libglm-dev, libfmt-dev, nlohmann-json3-dev, libpng-dev, zlib1g-dev, libassimp-dev, libmeshoptimizer-dev, libhdf5-dev, libaec-dev, libdeflate-dev, nettle-dev, libxxhash-dev, libseccomp-dev, libedit-dev, libspirv-cross-c-shared-dev, spirv-tools, glslang-dev, glslang-tools, libgl-dev, libegl-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS catch2)
foreach(component program development)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(changelog ${PROJECT_BINARY_DIR}/debian/${package}/changelog)
  file(WRITE ${changelog} "${package} (${PROJECT_VERSION}) unstable; urgency=medium\n\n  * Built from source by cpack.\n\n"
       " -- ${CPACK_PACKAGE_CONTACT}  Thu, 01 Jan 2026 00:00:00 +0000\n")
  execute_process(COMMAND gzip -9nf ${changelog} COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${changelog}.gz DESTINATION share/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES LICENSE DESTINATION share/doc/${package} RENAME copyright COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
include(CPack)
