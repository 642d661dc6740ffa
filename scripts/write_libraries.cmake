# SPDX-License-Identifier: LGPL-2.1-or-later
# cmake -DLIBRARY=FILE -DHEADER=FILE -P write_libraries.cmake: write the header
# of source/start.cc, the names of all libraries that LIBRARY depends on, those
# that others need first. `ldd` lists them in the other order. Without it the
# list is empty, which costs time but nothing else.
execute_process(COMMAND ldd ${LIBRARY} OUTPUT_VARIABLE lines ERROR_QUIET)
string(REGEX MATCHALL "[^ \t\n]+ => /" names "${lines}")
list(REVERSE names)
set(text)
foreach(name IN LISTS names)
  string(REPLACE " => /" "" name "${name}")
  string(APPEND text "  \"${name}\",\n")
endforeach()
get_filename_component(library ${LIBRARY} NAME)
file(WRITE ${HEADER} "// Written by write_libraries.cmake.
static const char *const program_library = \"${library}\";
static const char *const libraries[] = {\n${text}  \"\"};\n")
