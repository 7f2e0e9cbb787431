# find_package(swallowtail) after an install: the algorithms as libraries, without any DDS.
include(CMakePackageConfigHelpers)

# The component gtsp stands alone: it needs none of what the others do.
set(SWALLOWTAIL_GTSP_LIBRARIES base gtsp)
foreach(library ${SWALLOWTAIL_GTSP_LIBRARIES})
  install(TARGETS swallowtail_${library} EXPORT swallowtail-gtsp-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endforeach()
set(SWALLOWTAIL_LIBRARIES world path kernels scenario swarm cost replan field ground energy schedule maintain task)
foreach(library ${SWALLOWTAIL_LIBRARIES})
  install(TARGETS swallowtail_${library} EXPORT swallowtail-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endforeach()
install(DIRECTORY planner coverage DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swallowtail
        FILES_MATCHING PATTERN "*.hpp" PATTERN "participant" EXCLUDE PATTERN "detail" EXCLUDE
        PATTERN "gtsp/search" EXCLUDE PATTERN "gtsp/proof" EXCLUDE)
# What the kernels' headers hold by value.
install(DIRECTORY planner/kernels/detail DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swallowtail/planner/kernels
        FILES_MATCHING PATTERN "*.hpp")
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/swallowtail)
install(EXPORT swallowtail-gtsp-targets NAMESPACE swallowtail:: DESTINATION ${package_folder})
install(EXPORT swallowtail-targets NAMESPACE swallowtail:: DESTINATION ${package_folder})
configure_package_config_file(tools/cmake/swallowtail-config.cmake.in ${CMAKE_BINARY_DIR}/swallowtail-config.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/swallowtail-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/swallowtail-config.cmake ${CMAKE_BINARY_DIR}/swallowtail-config-version.cmake
        DESTINATION ${package_folder})
