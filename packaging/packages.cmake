# The Debian packages. `cpack -G DEB --config build/release/CPackConfig.cmake -B out/packages` builds them:
# starbow, the program with its files, and starbow-exhibit, which starts it with the machine.
include(GNUInstallDirs)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # packaging needs the program alone, not its tests
set(EXHIBIT ${CMAKE_CURRENT_LIST_DIR}/exhibit)

# compressed(FILE NAME): NAME.gz in the build's folder, without time and name, so that equal sources make equal packages.
function(compressed file name)
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/packaging)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  execute_process(COMMAND gzip -9nc ${file} OUTPUT_FILE ${CMAKE_BINARY_DIR}/packaging/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
endfunction()
compressed(${CMAKE_CURRENT_LIST_DIR}/starbow.1 starbow.1)
compressed(${CMAKE_CURRENT_LIST_DIR}/changelog changelog)

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${CMAKE_CURRENT_LIST_DIR}/catalog.py ${CMAKE_SOURCE_DIR}/docs/operation.md ${CMAKE_SOURCE_DIR}/config/model/log_kinds.h)
execute_process(COMMAND python3 ${CMAKE_CURRENT_LIST_DIR}/catalog.py ${CMAKE_BINARY_DIR}/packaging/starbow.catalog
  COMMAND_ERROR_IS_FATAL ANY)

install(TARGETS starbow DESTINATION bin COMPONENT starbow)
install(TARGETS starbow-tools DESTINATION lib/starbow COMPONENT starbow)
install(DIRECTORY config scenes DESTINATION share/starbow COMPONENT starbow
  PATTERN *.cpp EXCLUDE PATTERN *.h EXCLUDE PATTERN *.py EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN config/model EXCLUDE
  PATTERN config/json EXCLUDE PATTERN config/markup EXCLUDE PATTERN config/import EXCLUDE PATTERN config/udev EXCLUDE
  PATTERN LICENSE* EXCLUDE PATTERN README.md EXCLUDE)
install(DIRECTORY docs/ DESTINATION share/doc/starbow COMPONENT starbow
  FILES_MATCHING PATTERN *.md PATTERN *.svg PATTERN *.png PATTERN *.jpg PATTERN *.webm)
install(FILES packaging/starbow.desktop DESTINATION share/applications COMPONENT starbow)
install(FILES packaging/starbow.metainfo.xml DESTINATION share/metainfo COMPONENT starbow)
install(FILES config/udev/70-starbow.rules DESTINATION /lib/udev/rules.d COMPONENT starbow)
install(FILES ${CMAKE_BINARY_DIR}/packaging/starbow.1.gz DESTINATION share/man/man1 COMPONENT starbow)
foreach(package starbow starbow-exhibit)
  install(FILES packaging/copyright NOTICE ${CMAKE_BINARY_DIR}/packaging/changelog.gz
    DESTINATION share/doc/${package} COMPONENT ${package})
endforeach()

install(FILES ${EXHIBIT}/starbow.service ${EXHIBIT}/starbow-display.service ${EXHIBIT}/starbow-hours.service
  ${EXHIBIT}/starbow-hours.timer DESTINATION /lib/systemd/system COMPONENT starbow-exhibit)
install(PROGRAMS ${EXHIBIT}/hours ${EXHIBIT}/display-ready DESTINATION lib/starbow COMPONENT starbow-exhibit)
install(FILES ${CMAKE_BINARY_DIR}/packaging/starbow.catalog DESTINATION lib/systemd/catalog COMPONENT starbow-exhibit)
install(FILES ${EXHIBIT}/sysusers.conf DESTINATION lib/sysusers.d RENAME starbow.conf COMPONENT starbow-exhibit)
install(FILES ${EXHIBIT}/tmpfiles.conf DESTINATION lib/tmpfiles.d RENAME starbow.conf COMPONENT starbow-exhibit)
install(FILES ${EXHIBIT}/71-starbow-exhibit.rules DESTINATION /lib/udev/rules.d COMPONENT starbow-exhibit)
install(FILES ${EXHIBIT}/exhibit.json DESTINATION /etc/starbow COMPONENT starbow-exhibit)
install(FILES ${EXHIBIT}/site.json DESTINATION /etc/starbow/layouts COMPONENT starbow-exhibit)
install(FILES ${EXHIBIT}/hours.conf DESTINATION /etc/starbow RENAME hours COMPONENT starbow-exhibit)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME starbow)
set(CPACK_PACKAGE_VENDOR "Starbow authors")
# Debian wants an address; RFC 2606 keeps .invalid for those that are nobody's.
set(CPACK_PACKAGE_CONTACT "Starbow authors <authors@starbow.invalid>")
# Debian's control file has no field for a licence; the package's copyright file states it.
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_SET_DESTDIR ON) # files below /etc and /lib go into the package, not into this machine
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL starbow starbow-exhibit)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_COMPRESSION xz)

set(CPACK_DEBIAN_STARBOW_PACKAGE_NAME starbow)
set(CPACK_DEBIAN_STARBOW_FILE_NAME starbow.deb)
set(CPACK_DEBIAN_STARBOW_PACKAGE_SECTION science)
set(CPACK_DEBIAN_STARBOW_PACKAGE_SHLIBDEPS ON)
# The program opens the Vulkan loader itself, so dpkg-shlibdeps does not find it.
set(CPACK_DEBIAN_STARBOW_PACKAGE_DEPENDS "fonts-dejavu-core, libvulkan1, mesa-vulkan-drivers | vulkan-icd")
set(CPACK_DEBIAN_STARBOW_PACKAGE_RECOMMENDS "ffmpeg")
set(CPACK_DEBIAN_STARBOW_PACKAGE_SUGGESTS "weasyprint")
set(CPACK_COMPONENT_STARBOW_DESCRIPTION "flight near the speed of light
Starbow shows what physics says you would see near the speed of light:
aberration, the Doppler effect, the headlight effect. It draws on windows,
planetarium domes and stereo pairs, is flown with sticks and keyboard, and has
tours, a laboratory session and ray-traced reference pictures.")

set(CPACK_DEBIAN_STARBOW-EXHIBIT_PACKAGE_NAME starbow-exhibit)
set(CPACK_DEBIAN_STARBOW-EXHIBIT_FILE_NAME starbow-exhibit.deb)
set(CPACK_DEBIAN_STARBOW-EXHIBIT_PACKAGE_SECTION science)
set(CPACK_DEBIAN_STARBOW-EXHIBIT_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_STARBOW-EXHIBIT_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_STARBOW-EXHIBIT_PACKAGE_DEPENDS
  "starbow (= ${PROJECT_VERSION}), systemd, udev, xserver-xorg-core, x11-xserver-utils")
set(CPACK_DEBIAN_STARBOW-EXHIBIT_PACKAGE_RECOMMENDS "xserver-xorg-input-libinput")
set(CPACK_DEBIAN_STARBOW-EXHIBIT_PACKAGE_CONTROL_EXTRA
  "${EXHIBIT}/postinst;${EXHIBIT}/prerm;${EXHIBIT}/postrm;${EXHIBIT}/conffiles")
set(CPACK_COMPONENT_STARBOW-EXHIBIT_DESCRIPTION "Starbow as an exhibit that starts with the machine
A bare X server, and Starbow on it, as services of systemd: started with the
machine, watched, and restarted after a hang or a crash. The site's files are
in /etc/starbow, opening hours among them.")
include(CPack)
