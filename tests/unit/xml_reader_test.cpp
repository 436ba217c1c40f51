#include "io/mesh/xml_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mesh_samples.h"

namespace scarp::xml_reader_test {
namespace {

using Event = io::XmlReader::Event;

/// The events as text: "<a b=1>", "</a>", "text", "#comment", "." for the end, "!complaint".
std::string walk(const std::string& text) {
  const auto bytes = test::to_bytes(text);
  io::XmlReader xml(bytes);
  std::string events;
  for (;;) {
    switch (xml.next()) {
      case Event::kStart:
        events += fmt::format("<{}{}>", xml.name(), xml.attribute("b").empty() ? "" : " b=" + xml.attribute("b"));
        break;
      case Event::kEnd:
        events += fmt::format("</{}>", xml.name());
        break;
      case Event::kText:
        events += xml.text();
        break;
      case Event::kComment:
        events += fmt::format("#{}", xml.text());
        break;
      case Event::kDone:
        return events + ".";
      case Event::kBroken:
        return events + "!" + xml.complaint();
    }
  }
}

TEST(XmlReader, WalksThroughElementsTextAndComments) {
  EXPECT_EQ(walk("<?xml version=\"1.0\"?>\n<a><!-- x --><p:c b = '1 &lt; 2' d=\"\"/>t<![CDATA[<u>]]></a>\n<!--y-->"),
            "<a># x <c b=1 < 2></c>t<u></a>#y.");
}

TEST(XmlReader, InsistsOnOneRootThatIsClosedInOrder) {
  EXPECT_EQ(walk(""), "!it holds no element");
  EXPECT_EQ(walk("<a><b></a></b>"), "<a><b>!line 1: 'a' ends, which was not the last to begin");
  EXPECT_EQ(walk("<a>\n<b>"), "<a>\n<b>!it ends within 'b': it was cut off");
  EXPECT_EQ(walk("<a/><b/>"), "<a></a>!line 1: a second root begins");
  EXPECT_EQ(walk("<a/>x"), "<a></a>!line 1: there is text outside of the root");
  EXPECT_EQ(walk("<!DOCTYPE a [<!ENTITY e \"eee\">]><a/>"), "!line 1: document types are not read");
  EXPECT_EQ(walk("<a b=1/>"), "!line 1: the tag 'a' is broken or cut off");
  EXPECT_EQ(walk("< a/>"), "!line 1: a tag has no name");
}

TEST(XmlReader, UndoesWhatItWrites) {
  const std::string text = "a<b>&\"c' &amp; \xC3\xA4";
  EXPECT_EQ(io::undo_entities(io::with_entities(text)), text);
  EXPECT_EQ(io::undo_entities("&#65;&#x42;&#xe4;&#8364;&#x1F600;"), "AB\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80");
  EXPECT_EQ(io::undo_entities("&none; & &#; &#x; &#xFFFFFFFFF; &lt"), "&none; & &#; &#x; &#xFFFFFFFFF; &lt");
}

}  // namespace
}  // namespace scarp::xml_reader_test
