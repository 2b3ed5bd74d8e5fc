// For LeakSanitizer, which cannot name a module that is closed again and so
// cannot know that what leaks belongs to a plugin of Open MPI.
extern "C" int
dlclose(void *)
{
  return 0;
}
