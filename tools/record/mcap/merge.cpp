#include <algorithm>
#include <memory>
#include <unordered_map>

#include "tools/record/mcap/decode.hpp"
#include "tools/record/mcap/reader.hpp"

/// Messages of many regions in order of log time.
namespace swallowtail::mcap {

Result<std::vector<std::byte>> Reader::load(const Region& region) const {
  auto bytes = read_bytes(region.offset, region.length, limits_.max_chunk_bytes);
  if (!bytes || !region.is_chunk) return bytes;
  ByteSource source(*bytes);
  const auto record = take_record(source);
  if (!record || record->op != Op::kChunk) return bad_input("A chunk index does not point at a chunk.");
  const auto chunk = parse_chunk(record->content);
  if (!chunk) return chunk.error();
  if (chunk->start_ns != region.start_ns || chunk->end_ns != region.end_ns)
    return bad_input("A chunk and its index differ.");
  return unpack_chunk(*chunk, limits_.max_chunk_bytes);
}

/// The messages of one loaded region, in order.
class Reader::Cursor {
 public:
  static Result<std::unique_ptr<Cursor>> open(const Reader& reader, const Region& region) {
    auto records = reader.load(region);
    if (!records) return records.error();
    auto cursor = std::make_unique<Cursor>();
    cursor->records_ = std::move(*records);
    if (const Status indexed = cursor->index(region); !indexed) return indexed.error();
    return cursor;
  }

  bool at_end() const { return next_ == messages_.size(); }
  const Message& message() const { return messages_[next_]; }
  void advance() { ++next_; }

 private:
  Status index(const Region& region) {
    ByteSource source(records_);
    while (const auto record = take_record(source)) {
      if (record->op != Op::kMessage) continue;
      const auto message = parse_message(record->content);
      if (!message) return message.error();
      if (message->log_time_ns < region.start_ns || message->log_time_ns > region.end_ns) {
        return bad_input("A message's log time lies outside its chunk's.");
      }
      messages_.push_back(*message);
    }
    if (!source.at_end()) return bad_input("A chunk's last record is not whole.");
    std::stable_sort(messages_.begin(), messages_.end(),
                     [](const Message& a, const Message& b) { return a.log_time_ns < b.log_time_ns; });
    return {};
  }

  std::vector<std::byte> records_;
  std::vector<Message> messages_;
  std::size_t next_ = 0;
};

/// The regions that overlap in time, merged; `order` breaks ties in order of writing.
class Reader::Merge {
 public:
  void add(std::unique_ptr<Cursor> cursor, std::uint64_t order) {
    if (cursor->at_end()) return;
    open_.push_back({std::move(cursor), order});
    std::push_heap(open_.begin(), open_.end(), is_later);
  }
  bool empty() const { return open_.empty(); }
  std::uint64_t next_time_ns() const { return open_.front().cursor->message().log_time_ns; }
  const Message& message() const { return open_.front().cursor->message(); }
  void advance() {
    std::pop_heap(open_.begin(), open_.end(), is_later);
    open_.back().cursor->advance();
    if (open_.back().cursor->at_end()) {
      open_.pop_back();
    } else {
      std::push_heap(open_.begin(), open_.end(), is_later);
    }
  }

 private:
  struct Entry {
    std::unique_ptr<Cursor> cursor;
    std::uint64_t order;
  };
  static bool is_later(const Entry& a, const Entry& b) {
    return std::pair(a.cursor->message().log_time_ns, a.order) >
           std::pair(b.cursor->message().log_time_ns, b.order);
  }
  std::vector<Entry> open_;
};

Result<std::uint64_t> Reader::for_each_message(const MessageFunction& function, OnDamage on_damage) const {
  std::unordered_map<std::uint16_t, const Channel*> channels;
  for (const Channel& channel : channels_) channels[channel.id] = &channel;
  std::uint64_t damaged = 0;
  std::size_t next = 0;
  Merge merge;
  while (next < regions_.size() || !merge.empty()) {
    while (next < regions_.size() && (merge.empty() || regions_[next].start_ns <= merge.next_time_ns())) {
      const Region& region = regions_[next++];
      auto cursor = Cursor::open(*this, region);
      if (cursor) {
        merge.add(std::move(*cursor), region.offset);
      } else if (on_damage == OnDamage::kFail) {
        return bad_input(file_.name() + " is damaged at byte " + std::to_string(region.offset) + ": " +
                         cursor.error().message);
      } else {
        ++damaged;
      }
    }
    if (merge.empty()) break;
    const auto channel = channels.find(merge.message().channel_id);
    if (channel != channels.end()) {
      function(*channel->second, merge.message());
    } else if (on_damage == OnDamage::kFail) {
      return bad_input(file_.name() + " has a message of channel " +
                       std::to_string(merge.message().channel_id) + ", which it does not describe.");
    }
    merge.advance();
  }
  return damaged;
}

}  // namespace swallowtail::mcap
