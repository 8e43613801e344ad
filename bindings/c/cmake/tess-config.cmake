# The installed library, for find_package(tess):
#
#   tess::tess    the shared library, or the archive if there is no shared library
#   tess::static  the archive and the system's libraries that it needs; the linker omits functions that are not called
#
# Paths are relative to this file, so that the installation can be moved.
cmake_minimum_required(VERSION 3.13)
include(CMakeFindDependencyMacro)
get_filename_component(TESS_PREFIX "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

function(tess_target name kind file)
  if(NOT TARGET ${name} AND EXISTS "${file}")
    add_library(${name} ${kind} IMPORTED)
    set_target_properties(${name} PROPERTIES
      IMPORTED_LOCATION "${file}"
      INTERFACE_INCLUDE_DIRECTORIES "${TESS_PREFIX}/include")
  endif()
endfunction()

tess_target(tess::static STATIC "${TESS_PREFIX}/lib/libtess.a")
if(WIN32)
  tess_target(tess::tess SHARED "${TESS_PREFIX}/bin/tess_capi.dll")
  if(TARGET tess::tess)
    set_target_properties(tess::tess PROPERTIES IMPORTED_IMPLIB "${TESS_PREFIX}/lib/libtess.dll.a")
  endif()
  set(TESS_SYSTEM kernel32 ntdll userenv ws2_32 dbghelp)
  set(TESS_UNUSED -Wl,--gc-sections)
else()
  tess_target(tess::tess SHARED "${TESS_PREFIX}/lib/libtess${CMAKE_SHARED_LIBRARY_SUFFIX}")
  find_dependency(Threads)
  set(TESS_SYSTEM Threads::Threads ${CMAKE_DL_LIBS} m)
  if(APPLE)
    set(TESS_UNUSED -Wl,-dead_strip)
  else()
    set(TESS_UNUSED -Wl,--gc-sections)
  endif()
endif()
if(TARGET tess::static)
  set_target_properties(tess::static PROPERTIES
    INTERFACE_LINK_LIBRARIES "${TESS_SYSTEM}"
    INTERFACE_LINK_OPTIONS "${TESS_UNUSED}")
  if(NOT TARGET tess::tess)
    add_library(tess::tess INTERFACE IMPORTED)
    set_target_properties(tess::tess PROPERTIES INTERFACE_LINK_LIBRARIES tess::static)
  endif()
endif()
if(NOT TARGET tess::tess)
  set(tess_FOUND FALSE)
  set(tess_NOT_FOUND_MESSAGE "${TESS_PREFIX} has no library of tess for this system")
endif()
