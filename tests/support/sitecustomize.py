# SPDX-License-Identifier: BSD-3-Clause
"""ParaView 5.11 looks through all its classes for the documentation of each one, for a second at each start. Here it looks once."""
import importlib.util
import sys


def documentation(self, name):
    """Stands for ParaView's ProxyNamespace.getDocumentation."""
    if name not in self.__dict__.setdefault("documentations", {}):
        definitions = sys.modules["paraview.servermanager"].ProxyDefinitionIterator
        manager = self.session.GetProxyDefinitionManager()
        for group in self.xmlGroups:
            for item in definitions(manager.NewSingleGroupIterator(group, manager.ALL_DEFINITIONS)):
                text = item["xml"].FindNestedElementByName("Documentation")
                self.documentations[self._getPyName(xml=item["xml"])] = text.GetCharacterData() or "" if text else ""
    return self.documentations[name]


class Finder:
    """Finds ParaView's module as ever, and changes the function when it has run."""

    def find_spec(self, name, path=None, target=None):
        if name != "paraview.servermanager":
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(name)
        run = spec.loader.exec_module

        def exec_module(module):
            run(module)
            if hasattr(getattr(module, "ProxyNamespace", None), "getDocumentation"):
                module.ProxyNamespace.getDocumentation = documentation

        spec.loader.exec_module = exec_module
        return spec


sys.meta_path.insert(0, Finder())
