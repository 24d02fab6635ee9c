# Debian packages, by CPack (make package): the program, the library to compile against, the Python package; and what is
# loaded for MPI and for PETSc, where they are. What the library needs is inside the program and the modules, so that
# none of them needs headers.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME seiche)
set(CPACK_PACKAGE_CONTACT "The Seiche authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY "${PROJECT_SOURCE_DIR}/build/dist")
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/debian/finish.cmake")
set(CPACK_COMPONENTS_ALL seiche libseiche-dev python3-seiche)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
foreach(component IN LISTS CPACK_COMPONENTS_ALL ITEMS seiche-mpi seiche-petsc)
  string(TOUPPER "CPACK_DEBIAN_${component}_PACKAGE" ${component})
  set(${${component}}_NAME ${component})
  install(FILES LICENSE DESTINATION "share/doc/${component}" RENAME copyright COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

string(CONCAT about "Integrates nonlinear waves, lattices, oscillators and dispersive equations\n"
  "with friction, with the damping exact and the energy law of the equation kept\nin every step of any size.\n.\n")
set(CPACK_COMPONENT_SEICHE_DESCRIPTION "${about}The program, its manual, completion for bash, and cases to begin with.")
set(${seiche}_SECTION science)
# What draws. Fonttools, of which Matplotlib reads fonts, asks for SciPy, and so for a compiler, or for munkres.
set(${seiche}_DEPENDS "python3-munkres, python3-matplotlib (>= 3.6), python3-numpy, python3-h5py, fonts-dejavu-core")
set(${seiche}_SUGGESTS "ffmpeg, python3-seiche")  # films

set(CPACK_COMPONENT_LIBSEICHE-DEV_DESCRIPTION "${about}The library, its headers, its CMake package, its file for\npkg-config, and examples.")
set(${libseiche-dev}_SECTION libdevel)
string(CONCAT ${libseiche-dev}_DEPENDS "libeigen3-dev (>= 3.4), libfmt-dev (>= 9), libfftw3-dev, libsleef-dev, libginac-dev, libhdf5-dev, "
  "libssl-dev, zlib1g-dev, libtomlplusplus-dev, pkg-config")
set(${libseiche-dev}_SUGGESTS "cmake")

if(TARGET seiche_mpi_module)
  list(APPEND CPACK_COMPONENTS_ALL seiche-mpi)
  set(CPACK_COMPONENT_SEICHE-MPI_DESCRIPTION "${about}What the program loads where mpiexec starts it on several processes.")
  set(${seiche-mpi}_SECTION science)
  set(${seiche-mpi}_DEPENDS "seiche (= ${PROJECT_VERSION}), openmpi-bin")
endif()

if(TARGET seiche_ts)
  list(APPEND CPACK_COMPONENTS_ALL seiche-petsc)
  set(CPACK_COMPONENT_SEICHE-PETSC_DESCRIPTION "${about}Its methods as time steppers of PETSc, by -ts_type.")
  set(${seiche-petsc}_SECTION science)
endif()

if(TARGET seiche_python)
  set(CPACK_COMPONENT_PYTHON3-SEICHE_DESCRIPTION "${about}The package for Python 3.")
  set(${python3-seiche}_SECTION python)
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  set(${python3-seiche}_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  set(${python3-seiche}_RECOMMENDS "python3-matplotlib (>= 3.6), python3-scipy")  # seiche.plot, seiche.fit
  set(${python3-seiche}_SUGGESTS "python3-xarray")
  set(${python3-seiche}_CONTROL_EXTRA "${CMAKE_CURRENT_LIST_DIR}/debian/postinst;${CMAKE_CURRENT_LIST_DIR}/debian/prerm")
else()
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL python3-seiche)
endif()
include(CPack)

# All that is in the packages (make package).
add_custom_target(packaged)
foreach(part IN ITEMS seiche seiche_cli seiche_python seiche_mpi_module seiche_ts)
  if(TARGET ${part})
    add_dependencies(packaged ${part})
  endif()
endforeach()
