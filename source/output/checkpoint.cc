#include <deal.II/base/exceptions.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/output/checkpoint.h>
#include <mortise/output/checkpoint_file.h>
#include <mortise/output/checkpoint_records.h>
#include <mortise/output/checkpoint_scene.h>

#include <stdexcept>

namespace mortise
{
  std::string
  checkpoint_file_name(const std::string &directory)
  {
    return directory + "/checkpoint.bin";
  }

  void
  write_checkpoint(const std::string           &directory,
                   const Checkpoint            &checkpoint,
                   const Bodies                &bodies,
                   const std::vector<Coupling> &couplings,
                   const MPI_Comm               comm)
  {
    AssertDimension(checkpoint.solutions.size(), bodies.size());
    AssertDimension(checkpoint.multipliers.size(), couplings.size());
    write_checkpoint_file(checkpoint_file_name(directory),
                          {checkpoint.text,
                           pack(describe_scene(bodies, couplings, comm))},
                          pack_records(checkpoint, bodies, couplings),
                          comm);
  }

  std::string
  read_checkpoint_text(const std::string &directory, const MPI_Comm comm)
  {
    return CheckpointFile(checkpoint_file_name(directory), comm).header().text;
  }

  namespace
  {
    std::string
    message_of_difference(const std::string &file, const std::string &how)
    {
      return "The checkpoint " + file_in_quotes(file) +
             " is of another scene: " + how +
             "; allowed: the bodies, meshes, degrees and interfaces with which "
             "it was written";
    }
  } // namespace

  Checkpoint
  read_checkpoint(const std::string           &directory,
                  const Bodies                &bodies,
                  const std::vector<Coupling> &couplings,
                  const MPI_Comm               comm)
  {
    const std::string    name = checkpoint_file_name(directory);
    const CheckpointFile file(name, comm);
    SceneDescription     then;
    try
      {
        then = unpack_scene(file.header().scene);
      }
    catch (const std::out_of_range &error)
      {
        throw damaged_checkpoint(name, error.what());
      }
    std::string difference;
    for (const std::string &one :
         differences(then, describe_scene(bodies, couplings, comm)))
      difference += (difference.empty() ? "" : "; ") + one;
    throw_if_any(difference.empty() ? "" :
                                      message_of_difference(name, difference),
                 comm);

    RecordReader reader(bodies, couplings);
    file.for_each_block([&](const std::string &block) { reader.take(block); });
    difference = reader.finish();
    throw_if_any(difference.empty() ? "" :
                                      message_of_difference(name, difference),
                 comm);
    Checkpoint checkpoint = reader.result();
    checkpoint.text       = file.header().text;
    return checkpoint;
  }
} // namespace mortise
