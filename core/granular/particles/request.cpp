// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/request.h"

namespace granular
{
bool is_wanted(const Request::Choice& choice, std::string_view name, bool is_usual)
{
  return choice ? choice(name, is_usual) : is_usual;
}

bool is_wanted(const Request::Choice& choice, const ArrayInfo& array)
{
  const bool is_usual = !array.position_form;
  return is_wanted(choice, array.name, is_usual) ||
    (choice && !array.group.empty() && choice(array.group, is_usual));
}
}
