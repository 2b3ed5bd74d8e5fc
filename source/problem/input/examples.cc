#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/output/whole_file.h>
#include <mortise/problem/input/examples.h>
#include <mortise/problem/input/parameter_file.h>
#include <mortise/problem/shared_files.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <vector>

namespace mortise
{
  namespace
  {
    namespace fs = std::filesystem;

    std::string
    text_of(const fs::path &file)
    {
      std::ifstream     stream(file);
      std::stringstream text;
      text << stream.rdbuf();
      if (!stream || !text)
        throw InputError("cannot read the file " +
                         file_in_quotes(file.string()));
      return text.str();
    }

    std::vector<std::string>
    names_of_examples(const fs::path &scenes)
    {
      std::vector<std::string> names;
      for (const auto &entry : fs::directory_iterator(scenes))
        if (entry.path().extension() == ".prm")
          names.push_back(entry.path().stem().string());
      std::sort(names.begin(), names.end());
      return names;
    }

    using Files = std::map<std::string, std::string>;

    /// Add the scene @p name, what it includes, and its meshes, which it names
    /// where they will be: beside it.
    void
    add_files(const fs::path &share, const std::string &name, Files &files)
    {
      const std::regex  mesh(R"((\n *set File *= *)\.\./meshes/([^\s#]+))");
      const std::regex  other(R"((?:^|\n) *include +(\S+))");
      const std::string scene = text_of(share / "prm" / name);
      using Matches           = std::sregex_iterator;
      for (Matches i(scene.begin(), scene.end(), mesh); i != Matches(); ++i)
        files[i->str(2)] = text_of(share / "meshes" / i->str(2));
      for (Matches i(scene.begin(), scene.end(), other); i != Matches(); ++i)
        add_files(share, i->str(1), files);
      files[name] = std::regex_replace(scene, mesh, "$1$2");
    }

    /// Throws InputError if @p name is no scene or a file is there already.
    Files
    files_to_write(const std::string &name)
    {
      const fs::path share = shared_directory("prm").parent_path();
      const auto     names = names_of_examples(share / "prm");
      if (std::find(names.begin(), names.end(), name) == names.end())
        throw InputError("--example: no scene " + in_quotes(name) +
                         " comes with the program" + did_you_mean(name, names) +
                         "; mortise --example lists all");
      Files files;
      add_files(share, name + ".prm", files);
      std::string there;
      for (const auto &[file, text] : files)
        if (std::error_code error;
            fs::symlink_status(file, error).type() != fs::file_type::not_found)
          there += " " + file_in_quotes(file);
      if (!there.empty())
        throw InputError("--example " + name +
                         ": nothing was written, since these files are here "
                         "already:" +
                         there + "; move them away or go to another directory");
      return files;
    }
  } // namespace

  std::string
  list_of_examples()
  {
    const std::regex title(R"((?:^|\n)set Title *= *(.*))");
    const fs::path   scenes = shared_directory("prm");
    std::string      list;
    for (const std::string &name : names_of_examples(scenes))
      {
        const std::string scene = text_of(scenes / (name + ".prm"));
        std::smatch       found;
        list += name;
        if (std::regex_search(scene, found, title))
          list += std::string(name.size() < 28 ? 28 - name.size() : 1, ' ') +
                  found.str(1);
        list += "\n";
      }
    return list;
  }

  std::string
  write_example(const std::string &name, const MPI_Comm comm)
  {
    std::string written = "wrote", wrong;
    try
      {
        if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
          for (const auto &[file, text] : files_to_write(name))
            {
              write_whole_file(file, text, MPI_COMM_SELF);
              written += " " + file;
            }
      }
    catch (const InputError &error)
      {
        wrong = error.what();
      }
    throw_if_any(wrong, comm);
    return written + "; run it with: mortise " + name + ".prm\n";
  }
} // namespace mortise
