# What Debian's policy asks of a package's files: a compressed manual, and no search path but the system's.
file(GLOB manuals "${CPACK_TEMPORARY_DIRECTORY}/seiche/usr/share/man/man1/seiche.1")
foreach(manual IN LISTS manuals)
  execute_process(COMMAND gzip -9n "${manual}" COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(GLOB binaries "${CPACK_TEMPORARY_DIRECTORY}/seiche/usr/bin/seiche"
  "${CPACK_TEMPORARY_DIRECTORY}/python3-seiche/usr/lib/python3/dist-packages/seiche/_core.*.so")
foreach(binary IN LISTS binaries)
  file(RPATH_REMOVE FILE "${binary}")
endforeach()
