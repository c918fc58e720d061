// SPDX-License-Identifier: BSD-3-Clause
#include "granular/runs/run.h"

#include "granular/common/archive.h"
#include "granular/common/error.h"
#include "granular/common/pass.h"
#include "granular/common/words.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
IndexOptions index_options(const Kind& kind, const RunOptions& options)
{
  std::string names = options.column_names.empty() ? options.column_map : options.column_names;
  std::ranges::replace(names, ',', ' '); // no column has a comma in its name
  const std::vector<std::string_view> words = split_words(names);
  return { .format = &kind.format(),
    .column_names = { words.begin(), words.end() },
    .repeated_steps = kind.has_pieces ? options.repeated_steps
                                      : RepeatedSteps::Last, // no file is a piece of another
    .threads = options.threads };
}
}

void Run::refresh(const std::vector<std::string>& files, const RunOptions& options,
  Communicator& ranks, Notices& notices, Progress& progress)
{
  options_ = options;
  offers_.clear();
  looked_at_.clear();
  update_run_index(index_, ranks, files, index_options(*kind_, options), notices, progress);
}

Run Run::without_offers() const
{
  Run made(*kind_);
  made.options_ = options_;
  made.index_ = index_;
  return made;
}

void Run::set_options(const RunOptions& options)
{
  if (!options_.tell_the_same(options))
  {
    offers_.clear();
    looked_at_.clear();
  }
  options_ = options;
}

/// Frames with the same columns tell the same; files without a kind of frames are asked one by one.
std::string Run::key_of(std::size_t frame) const
{
  const FramePiece piece = index_.first_piece(frame);
  return piece.entry.kind && kind_->tells_by_columns ? piece.entry.kind->schema.text()
                                                     : "#" + std::to_string(frame);
}

const Offer& Run::offer(std::size_t frame, Progress& progress)
{
  std::string key = this->key_of(frame);
  const auto known = offers_.find(key);
  return known != offers_.end()
    ? known->second
    : offers_.emplace(std::move(key), kind_->offer({ *kind_, index_, frame, options_ }, progress))
        .first->second;
}

const Offer& Run::known_offer(std::size_t frame) const
{
  static const Offer nothing;
  const auto known = offers_.find(this->key_of(frame));
  return known == offers_.end() ? nothing : known->second;
}

void Run::look(Communicator& ranks, Progress& progress)
{
  do_together(ranks,
    [&]
    {
      ArchiveWriter packer;
      if (ranks.rank() == 0)
      {
        std::vector<std::string> keys;
        for (const std::size_t frame : kind_->looked_at(index_))
        {
          this->offer(frame, progress);
          keys.push_back(this->key_of(frame));
        }
        pass(packer, keys);
        for (const std::string& key : keys)
        {
          pass(packer, std::as_const(offers_.at(key)));
        }
      }
      ranks.broadcast(packer.bytes, 0);
      ArchiveReader unpacker{ packer.bytes };
      pass(unpacker, looked_at_);
      for (const std::string& key : looked_at_)
      {
        pass(unpacker, offers_[key]);
      }
    });
}

std::vector<OfferedArray> Run::arrays(std::size_t table) const
{
  std::vector<OfferedArray> all;
  for (const std::string& key : looked_at_)
  {
    std::ranges::copy(offers_.at(key).tables[table], std::back_inserter(all));
  }
  return all;
}

Communicator& Run::group(std::size_t frame, const Request& request,
  const std::vector<std::string>& names, Communicator& ranks, Communicator& alone) const
{
  ArchiveWriter same;
  same.number(frame);
  pass_form(same, request, options_);
  pass(same, names);
  const std::vector<std::string> all =
    ranks.all_gather(std::to_string(request.piece) + ' ' + same.bytes);
  bool together = request.pieces == ranks.size();
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    together = together && all[rank] == std::to_string(rank) + ' ' + same.bytes;
  }
  return together ? ranks : alone;
}

Tables Run::read(std::size_t frame, const Request& request, const Offer& offer, Communicator& ranks,
  Notices& notices, Progress& progress) const
{
  if (!offer.error.empty())
  {
    throw FormatError(offer.error, offer.where);
  }
  notices.insert(notices.end(), offer.notices.begin(), offer.notices.end());
  return kind_->read({ *kind_, index_, frame, options_ }, request, offer, ranks, notices, progress);
}
}
