# scree_need(<package> <least version or ""> <Debian package>): find_package with a message that says what to install.
#
# The version is compared here, not by find_package: some packages call their next major version incompatible
# where scree's use of them is not affected.
function(scree_need package least debian)
  set(mode CONFIG)
  if(package MATCHES "^(PNG|Threads|ZLIB)$")
    set(mode MODULE)
  endif()
  find_package(${package} ${mode} QUIET)
  if(${package}_FOUND AND (NOT least OR ${package}_VERSION VERSION_GREATER_EQUAL least))
    return()
  endif()
  set(wanted "${package}")
  if(least)
    string(APPEND wanted " ${least} or newer")
  endif()
  set(found "which was not found")
  if(${package}_FOUND)
    set(found "but found ${${package}_VERSION}")
  endif()
  message(FATAL_ERROR "scree needs ${wanted}, ${found}.\n"
    "On Debian and Ubuntu: apt-get install ${debian}\n"
    "On other systems: see 'Other systems' in README.md"
  )
endfunction()
