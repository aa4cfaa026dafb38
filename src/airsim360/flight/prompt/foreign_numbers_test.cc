// Number words of four languages in digits.
#include "airsim360/flight/prompt/foreign_numbers.h"

#include <gtest/gtest.h>

#include <string>

namespace airsim360::internal {
namespace {

TEST(ForeignNumbers, OfSeveralPartsAreWrittenInDigits) {
  const std::pair<const char*, const char*> cases[] = {
      {"zweieinhalb kilo", "2.5 kilo"},
      {"funfundzwanzig minuten", "25 minuten"},
      {"zweitausendfunfhundert gramm", "2500 gramm"},
      {"hundertzwanzig", "120"},
      {"achthundert g", "800 g"},
      {"mil quinientos gramos", "1500 gramos"},
      {"veinticinco minutos", "25 minutos"},
      {"treinta y cinco minutos", "35 minutos"},
      {"dos mil trescientos", "2300"},
      {"ciento veinte", "120"},
      {"kilo y medio", "1.5 kilo"},
      {"dos kilos y medio", "2.5 kilos"},
      {"una hora y media", "1.5 hora"},
      {"vingt-cinq minutes", "25 minutes"},
      {"quatre-vingt-dix", "90"},
      {"soixante-quinze", "75"},
      {"mille cinq cents grammes", "1500 grammes"},
      {"deux kilos et demi", "2.5 kilos"},
      {"vingt et un", "21"},
      {"venticinque minuti", "25 minuti"},
      {"duecento", "200"},
      {"chilo e mezzo", "1.5 chilo"},
      {"peso di mille cinquecento grammi", "peso di 1500 grammi"},
  };
  for (const auto& [words, digits] : cases) EXPECT_EQ(WithForeignNumbers(words), digits);
}

// Ones before tens, as German says them: all of them come back.
TEST(ForeignNumbers, EveryGermanNumberBelowAThousandComesBack) {
  const char* ones[] = {"", "ein", "zwei", "drei", "vier", "funf", "sechs", "sieben", "acht", "neun"};
  const char* tens[] = {"", "", "zwanzig", "dreissig", "vierzig", "funfzig", "sechzig", "siebzig", "achtzig", "neunzig"};
  for (int n = 121; n < 1000; ++n) {
    const int hundred = n / 100, ten = n / 10 % 10, one = n % 10;
    if (ten < 2 || one == 0) continue;
    const std::string word = std::string(ones[hundred]) + "hundert" + ones[one] + "und" + tens[ten];
    EXPECT_EQ(WithForeignNumbers(word + " gramm"), std::to_string(n) + " gramm") << word;
  }
}

TEST(ForeignNumbers, OtherWordsStay) {
  for (const char* text : {"a quad with six motors", "once more, 20 mil thick", "vier motoren", "hexa-frame in carbon", "thousand island",
                           "une camera de 300 g", "sei motori", "y medio", "hundert", "undundund", "einhalbtausend"})
    EXPECT_EQ(WithForeignNumbers(text), text);
  const std::string hard = std::string(400, 'u') + "und" + std::string(500, 'e');
  EXPECT_EQ(WithForeignNumbers(hard), hard);
}

}  // namespace
}  // namespace airsim360::internal
