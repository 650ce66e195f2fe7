# What `cmake --install` lays down: the program, and the engine for other programs (find_package(acus), acus::acus).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# The public face: acus.h and what it needs.
add_library(acus_engine INTERFACE)
target_link_libraries(acus_engine INTERFACE acus_sim)
target_compile_features(acus_engine INTERFACE cxx_std_20)
set_target_properties(acus_engine PROPERTIES EXPORT_NAME acus)
add_library(acus::acus ALIAS acus_engine)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/acus)
install(TARGETS acus RUNTIME)
install(TARGETS acus_engine acus_base acus_numeric acus_mesh acus_tissue acus_needle acus_coupling acus_force acus_sim
        EXPORT acus ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/acus)
install(DIRECTORY src/acus/base src/acus/numeric src/acus/mesh src/acus/tissue src/acus/needle src/acus/coupling
                  src/acus/force src/acus/sim
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/acus FILES_MATCHING PATTERN "*.h" PATTERN pch.h EXCLUDE)
install(FILES src/acus/acus.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/acus)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(EXPORT acus NAMESPACE acus:: FILE acus-targets.cmake DESTINATION ${package_dir})

configure_file(cmake/acus-config.cmake.in acus-config.cmake @ONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/acus-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/acus-config.cmake ${PROJECT_BINARY_DIR}/acus-config-version.cmake
        DESTINATION ${package_dir})
