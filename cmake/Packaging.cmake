# What `cmake --install` puts where, and the Debian package (`cpack` in the build folder).
include(GNUInstallDirs)
set(document_folder ${CMAKE_INSTALL_DATAROOTDIR}/doc/scene-analyzer)

install(TARGETS scene-analyzer RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# What it starts; files/helper_program.h looks for them there.
install(TARGETS scene-analyzer-import scene-analyzer-serve RUNTIME DESTINATION libexec/scene-analyzer)
# For those who write clients of the service.
install(DIRECTORY proto DESTINATION ${CMAKE_INSTALL_DATADIR}/scene-analyzer)
# Debian's name for the licence; minimal images drop every other document of a package.
install(FILES LICENSE DESTINATION ${document_folder} RENAME copyright)
install(FILES README.md NOTICE.md DESTINATION ${document_folder})
install(DIRECTORY docs DESTINATION ${document_folder})
install(FILES examples/living-room.glb DESTINATION ${CMAKE_INSTALL_DATADIR}/scene-analyzer/examples)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME scene-analyzer)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "Scene Analyzer developers <scene-analyzer@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGE_DESCRIPTION
    "scene-analyzer reads 3D assets in some forty formats, measures every mesh on a\nVulkan device and rates it by coplanar triangles, density, uneven triangle\nareas, distance and time to draw, as a table, JSON or CSV.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
# Linked libraries are found by dpkg-shlibdeps. The Vulkan loader is opened at run time, so it is invisible
# there; any Vulkan driver will do, and Mesa's package brings lavapipe for machines without a GPU.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libvulkan1)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS mesa-vulkan-drivers)
include(CPack)
