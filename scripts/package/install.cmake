# What `cmake --install` leaves: a component a library (cmake --install build --component sfsm), each with its headers and
# an export of its own, so that find_package(Grandstand COMPONENTS sfsm) asks for nothing that the others stand on.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Grandstand)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/GrandstandConfigVersion.cmake COMPATIBILITY SameMinorVersion)

# The targets named after it are those that the component is made of.
function(grandstand_install component)
  install(TARGETS ${ARGN} EXPORT Grandstand-${component}
          ARCHIVE COMPONENT ${component}
          FILE_SET HEADERS COMPONENT ${component})
  install(EXPORT Grandstand-${component} NAMESPACE Grandstand:: DESTINATION ${package_folder} COMPONENT ${component})
  install(FILES ${PROJECT_SOURCE_DIR}/scripts/package/GrandstandConfig.cmake ${PROJECT_BINARY_DIR}/GrandstandConfigVersion.cmake
          DESTINATION ${package_folder} COMPONENT ${component})
endfunction()

grandstand_install(sfsm sfsm)
if(TARGET pointsample)
  grandstand_install(pointsample model motion pointsample)
  get_directory_property(embree_version DIRECTORY ${PROJECT_SOURCE_DIR}/pointsample DEFINITION EMBREE_VERSION_MAJOR)
  configure_file(scripts/package/Grandstand-pointsample-needs.cmake.in Grandstand-pointsample-needs.cmake @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/Grandstand-pointsample-needs.cmake
          DESTINATION ${package_folder} COMPONENT pointsample)
endif()
