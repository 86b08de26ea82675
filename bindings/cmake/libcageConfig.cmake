# find_package(libcage) after `make install`: the target libcage::cage.
get_filename_component(_cage_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET libcage::cage)
  add_library(libcage::cage STATIC IMPORTED)
  set_target_properties(libcage::cage PROPERTIES
    IMPORTED_LOCATION "${_cage_prefix}/lib/libcage.a"
    INTERFACE_INCLUDE_DIRECTORIES "${_cage_prefix}/include")
endif()
unset(_cage_prefix)
