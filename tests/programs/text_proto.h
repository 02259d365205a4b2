#pragma once

#include <google/protobuf/text_format.h>
#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <string>

namespace cellcrush::testing {

/// Adds what a text says to a message; single values replace those that are there.
template <class Message>
Message with_text(Message message, const std::string& text) {
  EXPECT_TRUE(google::protobuf::TextFormat::MergeFromString(text, &message)) << text;
  return message;
}

/// The message that a text describes.
template <class Message>
Message from_text(const std::string& text) {
  return with_text(Message(), text);
}

/// The message that a JSON object describes.
template <class Message>
Message from_json(const std::string& text) {
  Message message;
  EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text, &message).ok()) << text;
  return message;
}

}  // namespace cellcrush::testing
