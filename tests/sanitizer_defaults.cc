// SPDX-License-Identifier: LGPL-2.1-or-later
// What the sanitizers of a build with NPT_SANITIZE are told, within the
// programs: tests start them with an empty environment, too.

extern "C"
{
  // ASAN_OPTIONS of the environment go before these.
  const char *
  __asan_default_options()
  {
    // deal.II's library is not checked, and has the same names as its headers.
    return "detect_leaks=1:detect_odr_violation=0:strict_string_checks=1:"
           "detect_stack_use_after_return=1:allocator_may_return_null=1";
  }

  const char *
  __ubsan_default_options()
  {
    return "print_stacktrace=1";
  }

  // Tests compare what programs say on standard error.
  const char *
  __lsan_default_options()
  {
    return "print_suppressions=0";
  }

  // What libraries keep until the process ends, by the names of the libraries.
  const char *
  __lsan_default_suppressions()
  {
    return "leak:libmpi\n"
           "leak:libopen-rte\n"
           "leak:libopen-pal\n"
           "leak:libpmix\n"
           "leak:libhwloc\n"
           "leak:libevent\n"
           "leak:libucs\n"
           "leak:libucp\n"
           "leak:libfabric\n"
           "leak:libpciaccess\n"
           "leak:mca_\n"
           "leak:libmumps_common\n"       // names of files with factors
           "leak:argz_add_sep\n"          // folders of the C library's LOCPATH
           "leak:__vasprintf_internal\n"; // of Open MPI; nobody here calls it
  }

  // Libraries stay, so that what they leave can be told by their names.
  int
  dlclose(void *)
  {
    return 0;
  }
}
