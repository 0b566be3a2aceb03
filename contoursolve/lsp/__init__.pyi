from .command import lsp as lsp
