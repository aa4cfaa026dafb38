#include "airsim360/render/products.h"

#include "airsim360/base/choice.h"

namespace airsim360 {

std::vector<std::string> ProductNames() {
  std::vector<std::string> names;
  for (const ProductInfo& product : kProducts) names.emplace_back(product.name);
  return names;
}

Products WithProducts(Products products, std::span<const std::string> names, std::string_view where) {
  const std::vector<std::string> choices = ProductNames();
  for (const std::string& name : names) products.*kProducts[ParseChoice("product", name, choices, where)].wanted = true;
  return products;
}

std::vector<std::string> NamesOf(const Products& products) {
  std::vector<std::string> names;
  for (const ProductInfo& product : kProducts) {
    if (products.*product.wanted) names.emplace_back(product.name);
  }
  return names;
}

Products Rendered(Products products) {
  products.semantic |= products.part;
  products.material |= products.part;
  products.entity |= products.sky;
  return products;
}

}  // namespace airsim360
