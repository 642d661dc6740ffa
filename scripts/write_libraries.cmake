# SPDX-License-Identifier: LGPL-2.1-or-later
# cmake -DLIBRARY=FILE -DFOLDER=DIR -DCOMPILER=FILE -DIDLE=REGEX -P
# write_libraries.cmake: write DIR/libraries.h, the header of source/start.cc:
# the names of all libraries that LIBRARY depends on, those that others need
# first. `ldd` lists them in the other order. Without it the lists are empty,
# which costs time but nothing else.
#
# Libraries whose names match lib(IDLE).so are those that LIBRARY never calls. In
# the folder DIR/idle their names are links to one small library, which has what
# deal.II asks of them by name, so that it can be loaded: whoever calls it ends
# the program. If that cannot be made, DIR/idle is empty, and the libraries
# themselves are loaded.
set(idle_folder ${FOLDER}/idle)
set(stand_in ${idle_folder}/libidle.so)

# Set `names` to what LIBRARY loads, without those of DIR/idle, and `missing` to
# the names of functions and data that nobody has.
macro(ask_linker)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env
      LD_LIBRARY_PATH=${idle_folder} ldd -r ${LIBRARY}
    OUTPUT_VARIABLE answer ERROR_VARIABLE missing)
  string(APPEND missing "${answer}")
  string(REGEX MATCHALL "undefined symbol: [^ \t\n]+( version [^ \t\n]+)?"
    missing "${missing}")
  list(REMOVE_DUPLICATES missing)
  string(REGEX MATCHALL "[^ \t\n]+ => /[^ \t\n]+" names "${answer}")
  list(REVERSE names)
  list(FILTER names EXCLUDE REGEX "=> ${idle_folder}/")
  list(TRANSFORM names REPLACE " => .*" "")
endmacro()

# Compile DIR/idle/libidle.so with the names in `missing`.
macro(write_stand_in)
  set(source)
  set(versions)
  foreach(entry IN LISTS missing)
    string(REGEX REPLACE "undefined symbol: ([A-Za-z0-9_]+).*" "\\1" name
      "${entry}")
    # Virtual tables and types; everything else is taken for a function.
    if(name MATCHES "^_ZT")
      string(APPEND source "char ${name}[256];\n")
    else()
      string(APPEND source
        "void ${name}() __attribute__((alias(\"npt_idle\")));\n")
    endif()
    if(entry MATCHES " version (.*)")
      set(version ${CMAKE_MATCH_1})
      list(APPEND versions ${version})
      string(APPEND names_of_${version} " ${name};")
    endif()
  endforeach()
  set(map)
  list(REMOVE_DUPLICATES versions)
  foreach(version IN LISTS versions)
    string(APPEND map "${version} {${names_of_${version}} };\n")
  endforeach()
  file(WRITE ${FOLDER}/idle.map "${map}")
  file(WRITE ${FOLDER}/idle.cc "// Written by write_libraries.cmake.
#include <cstdio>
#include <cstdlib>
extern \"C\" {
void npt_idle()
{
  std::fputs(\"A library was called that this program is started without. \"
             \"Configure it with -DNPT_FAST_START=OFF.\\n\",
             stderr);
  std::_Exit(3);
}
${source}}
")
  set(options)
  if(versions)
    set(options -Wl,--version-script=${FOLDER}/idle.map)
  endif()
  execute_process(COMMAND ${COMPILER} -shared -fPIC -w -o ${stand_in}
    ${FOLDER}/idle.cc ${options} RESULT_VARIABLE result ERROR_QUIET)
endmacro()

file(REMOVE_RECURSE ${idle_folder})
file(MAKE_DIRECTORY ${idle_folder})
ask_linker()
set(idle_names ${names})
list(FILTER idle_names INCLUDE REGEX "^lib(${IDLE})[.-]")
if(idle_names AND NOT missing)
  # With one that has no names the dynamic linker says which are missed.
  write_stand_in()
  foreach(name IN LISTS idle_names)
    file(CREATE_LINK libidle.so ${idle_folder}/${name} SYMBOLIC)
  endforeach()
  ask_linker()
  write_stand_in()
  ask_linker()
  if(missing OR NOT result EQUAL 0)
    file(REMOVE_RECURSE ${idle_folder})
    file(MAKE_DIRECTORY ${idle_folder})
    ask_linker()
  endif()
endif()

get_filename_component(library ${LIBRARY} NAME)
set(text "// Written by write_libraries.cmake.
static const char *const program_library = \"${library}\";\n")
foreach(list names idle_names)
  string(REPLACE names libraries title ${list})
  string(APPEND text "static const char *const ${title}[] = {\n")
  foreach(name IN LISTS ${list})
    string(APPEND text "  \"${name}\",\n")
  endforeach()
  string(APPEND text "  \"\"};\n")
endforeach()
file(WRITE ${FOLDER}/libraries.h "${text}")
