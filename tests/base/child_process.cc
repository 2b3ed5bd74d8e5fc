// Work in a process of its own: what it returns comes back whole, what it
// changes does not, and however it ends is told.

#include <mortise/base/child_process.h>
#include <verdict.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

namespace
{
  std::string
  end_of(const std::function<std::vector<char>()> &work)
  {
    try
      {
        mortise::in_child_process(work);
      }
    catch (const std::bad_alloc &)
      {
        return "no memory";
      }
    catch (const std::runtime_error &error)
      {
        return error.what();
      }
    return "(no error)";
  }
} // namespace

int
main()
{
  int               changed = 0;
  std::vector<char> much(3000000);
  for (std::size_t i = 0; i < much.size(); ++i)
    much[i] = i % 251;
  verdict(mortise::in_child_process([&] {
            changed = 1;
            return much;
          }) == much &&
            changed == 0,
          "three million bytes come back, nothing is changed");
  verdict(mortise::in_child_process([] { return std::vector<char>(); }).empty(),
          "nothing comes back");
  verdict(end_of([]() -> std::vector<char> { std::abort(); }) ==
            "it crashed (Aborted)",
          "an abort is told");
  verdict(end_of([]() -> std::vector<char> {
            std::raise(SIGSEGV);
            return {};
          }) == "it crashed (Segmentation fault)",
          "a segmentation fault is told");
  verdict(end_of([]() -> std::vector<char> { throw 1; }) ==
            "it ended before its work was done",
          "an exception is told");
  verdict(end_of([]() -> std::vector<char> { throw std::bad_alloc(); }) ==
            "no memory",
          "a lack of memory is one here, too");
  verdict(end_of([]() -> std::vector<char> {
            std::thread([] { throw std::bad_alloc(); }).join();
            return {};
          }) == "no memory",
          "one of a thread, too");
}
