"""google.rpc.Status: that of an installed googleapis-common-protos, since a name is registered only once; else ours."""
try:
    from google.rpc import status_pb2
except ImportError:
    from cellcrush.v1.google.rpc import status_pb2

__all__ = ["status_pb2"]
