// SPDX-License-Identifier: BSD-3-Clause
#include "granular/writing/whole_writer.h"

#include "granular/bytes/byte_sink.h"
#include "granular/bytes/compression.h"
#include "granular/writing/file_names.h"

#include <memory>
#include <utility>

namespace granular
{
WholeWriter::WholeWriter(
  std::string path, bool holds_many, const WriteOptions& options, Communicator& ranks)
  : path_(std::move(path))
  , holds_many_(holds_many)
  , durable_(is_durable(options.durable, path_))
  , inputs_(options.inputs)
  , ranks_(ranks)
  , held_(options.inputs)
{
}

void WholeWriter::write(std::int64_t timestep, const Encode& encode, Notices& notices)
{
  do_together(ranks_,
    [&]
    {
      if (ranks_.rank() != 0)
      {
        return;
      }
      const std::string to = name_of_new_step(path_, timestep, steps_);
      if (inputs_ != nullptr)
      {
        inputs_->has(to); // throws for a file that may not be replaced
      }
      if (is_name_of_steps(path_))
      {
        this->save(to, this->encode_frame(encode, notices));
        return;
      }
      if (steps_.size() > 1 && !holds_many_)
      {
        throw UnsupportedError(
          "expected a '*' in the name, which gives each time step its file: this file holds one",
          { path_ });
      }
      text_ += this->encode_frame(encode, notices);
    });
}

std::string WholeWriter::encode_frame(const Encode& encode, Notices& notices) const
{
  Notices own;
  try
  {
    std::string text = encode(own);
    for (Notice& notice : own)
    {
      notice.where.path = path_;
      notices.push_back(std::move(notice));
    }
    return text;
  }
  catch (const UnsupportedError& error)
  {
    throw UnsupportedError(error.text(), { .path = path_, .column = error.where().column });
  }
}

void WholeWriter::save(const std::string& path, const std::string& text)
{
  const Compression how = compression_of_name(path);
  auto file = std::make_unique<NewFile>(path);
  file->write_at(0, how == Compression::None ? text : compress(text, how));
  held_.finish(std::move(file), durable_);
}

void WholeWriter::finish()
{
  do_together(ranks_,
    [&]
    {
      if (ranks_.rank() == 0 && !is_name_of_steps(path_))
      {
        this->save(path_, text_);
      }
      held_.finish_all(durable_);
    });
}
}
