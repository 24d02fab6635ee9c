"""Pictures by Matplotlib: those of `seiche plot`, and what `seiche.plot` draws with. It needs nothing else of Seiche."""
