// Empty: a target that precompiles headers for others needs a unit of its own.
